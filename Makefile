# make demo   set everything up and run the main job on a real example
# make test   set everything up and pass the tests
# make bench  figures of ncscope and its peers, measured in one run
# make check  formatting, lint, types, import contract and tests

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
STAMP := $(VENV)/.installed

.PHONY: demo test check format docs bench workbench-js screenshots bench-workbench clean

$(STAMP): pyproject.toml
	$(PYTHON) -m venv $(VENV)
	$(BIN)/python -m pip install --quiet --disable-pip-version-check --editable ".[dev,table,workbench,browser]"
	$(BIN)/python -m compileall -q src
	touch $(STAMP)

demo: $(STAMP)
	rm -rf build/demo
	$(BIN)/ncscope run examples/programs/test_program_A.nc --machine examples/machines/xyzac_axes --messages build/demo
	$(BIN)/ncscope run examples/programs/zero_offsets.nc --machine examples/machines/zero_list_repaired --messages build/demo
	$(BIN)/ncscope explain examples/programs/five_axis.nc:N60 --machine examples/machines/ca_head

test: $(STAMP)
	$(BIN)/python -m pytest

check: $(STAMP)
	$(BIN)/ruff format --check src tests benchmarks
	$(BIN)/ruff check src tests benchmarks
	$(BIN)/mypy
	$(BIN)/lint-imports
	$(BIN)/python -m pytest

format: $(STAMP)
	$(BIN)/ruff format src tests benchmarks
	$(BIN)/ruff check --fix src tests benchmarks

docs: $(STAMP)
	$(BIN)/python -m ncscope.docs docs

bench: $(STAMP)
	$(BIN)/python benchmarks/bench.py --long 10000000
	$(BIN)/python benchmarks/loop.py

# The scripts of the workbench: needs node and npm; the result is checked in.
workbench-js:
	cd workbench_js && npm ci --no-audit --no-fund && npm run build && npm test

# Pictures of the main states of the workbench, to be looked at: build/screenshots.
screenshots: $(STAMP)
	$(BIN)/python tests/workbench/screenshots.py build/screenshots
	cp build/screenshots/overview_light.png docs/pictures/workbench.png

# Time to the first picture and memory for a program of a million blocks.
bench-workbench: $(STAMP)
	$(BIN)/python benchmarks/workbench.py

clean:
	rm -rf $(VENV) build
