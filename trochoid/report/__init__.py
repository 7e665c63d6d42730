"""The report: one self-contained HTML file for an engineer who sees the run for the first time."""

from trochoid.report.page import render

__all__ = ["render"]
