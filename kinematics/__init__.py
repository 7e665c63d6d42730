"""Exact kinematics and tooth profiles."""
