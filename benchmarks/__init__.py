"""What accuracy costs: measured numbers beside their targets (python -m benchmarks)."""
