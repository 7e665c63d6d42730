"""The RV (2K-V) drive: involute first stage, crankshafts, cycloid discs between ring pins, carrier."""
