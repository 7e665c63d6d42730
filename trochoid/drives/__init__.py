"""The drives: what each is made of."""
