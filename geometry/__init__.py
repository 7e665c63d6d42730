"""Outlines and meshes."""
