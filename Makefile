# Needs git, make and Python 3.11 or later; `make help` lists what it does.
# The set-up lives in .venv and is repeated only when a lock file or pyproject.toml has changed.

SHELL := /bin/sh
.NOTPARALLEL:
.PHONY: run test check benchmark lock clean help

# One thread per linear-algebra pool: numpy, scipy and cvxopt bring one each, and they would fight for the cores.
test: export OMP_NUM_THREADS := 1
test: export OPENBLAS_NUM_THREADS := 1
test: export MKL_NUM_THREADS := 1

run: ## set everything up and compute examples/cycloid.toml
	@sh .ci/setup run
	@.venv/bin/trochoid run examples/cycloid.toml --out out/cycloid
	@echo "Report: out/cycloid/report.html"

test: ## set everything up and run all tests
	@sh .ci/setup dev
	@.venv/bin/python -m pytest --numprocesses auto --dist loadfile

check: ## style, types and the import contract
	@sh .ci/setup dev
	.venv/bin/ruff check
	.venv/bin/ruff format --check
	.venv/bin/mypy
	.venv/bin/lint-imports --no-logo

benchmark: ## measured speed and accuracy beside their targets; takes a minute or two
	@sh .ci/setup run
	@.venv/bin/python -m benchmarks

lock: ## choose the newest dependencies that pyproject.toml allows and lock them
	@sh .ci/lock

clean: ## remove results and build products; the set-up stays
	rm -rf out build dist *.egg-info .mypy_cache .pytest_cache .ruff_cache .import_linter_cache

help: ## this list
	@sed -n 's/^\([a-z]*\): ## /  make \1 \t/p' Makefile
