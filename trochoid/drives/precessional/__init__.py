"""The precessional K-H-V drive: a nutating satellite between pins and sphere teeth."""
