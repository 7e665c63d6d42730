"""The spherical planetary-pin indexer: a pin on a spherical planet drives a slotted link in steps."""
