"""The sources, reproduced: every published number beside the computed one, every misprint with its test."""
