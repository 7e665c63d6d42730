"""Reactions and vibration."""
