"""trochoid."""
