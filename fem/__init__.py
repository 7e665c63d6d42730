"""Elastic bodies, contact and bearings."""
