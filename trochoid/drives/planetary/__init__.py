"""The involute planetary set 2K-H: sun, planets, ring, carrier."""
