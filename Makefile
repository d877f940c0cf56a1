# Every command sets up what it needs in .venv, from the versions locked in requirements/, and only when these change.
# Another Python: make test PYTHON=/path/to/python3.12

VENV := .venv
ifeq ($(OS),Windows_NT)
BIN := $(VENV)/Scripts
else
BIN := $(VENV)/bin
endif
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
NEW_ENOUGH := import sys; sys.exit(sys.version_info < (3, 11))

RUN := $(VENV)/run.stamp
DEV := $(VENV)/dev.stamp
DOCS := $(VENV)/docs.stamp

.PHONY: help setup demo quick test slow lint format verification actuators gallery reference docs dist bench robustness fuzz kills truth guidelines measured fast lock clean

help:
	@echo "make demo          run the fast PneuNet of examples/fast_pneunet.toml; the results go to runs/demo"
	@echo "make quick         fast unit tests, a minute at most; CONTRIBUTING.md says how to test one folder"
	@echo "make test          all tests but the slow ones, and the examples in the docstrings"
	@echo "make slow          the slow tests"
	@echo "make lint          ruff, import-linter, mypy (of the examples, too), spelling, and types of the studio's page"
	@echo "make format        let ruff format and tidy the code"
	@echo "make verification  all verification tests (half an hour of one core); renews docs/verification.md"
	@echo "make actuators     write docs/actuators from the families, with their pictures (some minutes)"
	@echo "make gallery       draw the animations of docs/gallery.md, and run the notebook for docs/first-finger.md (some minutes)"
	@echo "make reference     write docs/reference/job-file.md and names.md from the code"
	@echo "make docs          build the documentation into docs/_build/html; a warning is an error"
	@echo "make dist          build source archive and wheel, check them, and run a small job from the wheel with each Python found"
	@echo "make bench         run the benchmarks; writes benchmarks/results"
	@echo "make robustness    run the hard cases (some minutes); writes benchmarks/robustness/robustness.md"
	@echo "make fuzz          10,000 damaged files (seven minutes of one core); make test tries 150"
	@echo "make kills         commands killed at 200 random moments, and runs at once on cold caches (half an hour of one core)"
	@echo "make truth         run the truth set (an hour or two of one core); renews docs/truth.md. It installs NGSolve into"
	@echo "                   .venv, whose wheel carries UMFPACK (GPL): for development only"
	@echo "make guidelines    run the guidelines of the literature (an hour of two cores); renews docs/guidelines.md"
	@echo "make measured      compare with measured actuators (half an hour of one core); renews docs/measured-actuators.md"
	@echo "make fast          install MKL into .venv (x86-64 only, proprietary): factorizes faster"
	@echo "make lock          renew requirements/*.lock from pyproject.toml (needs uv)"
	@echo "make clean         remove .venv, caches and what was built"

setup: $(RUN)

demo: $(RUN)
	$(BIN)/turgor run examples/fast_pneunet.toml --output runs/demo --force

# Folders whose tests are fast: 1,341 tests in 85 CPU seconds together, once the kernels are compiled.
QUICK := $(addprefix tests/unit/,core/materials core/model core/solvers fast_models/formulas)

quick: $(DEV)
	$(BIN)/python -m pytest -n auto $(QUICK)

test: $(DEV)
	$(BIN)/python -m pytest -n auto --dist worksteal

slow: $(DEV)
	$(BIN)/python -m pytest -m slow

lint: $(DEV)
	$(BIN)/ruff check
	$(BIN)/ruff format --check
	$(BIN)/lint-imports --no-logo
	$(BIN)/mypy
	$(BIN)/typos
	@if npx --yes -p typescript@5.9.3 tsc --version > /dev/null 2>&1; then \
	  npx --yes -p typescript@5.9.3 tsc -p src/turgor/studio/page/jsconfig.json; \
	else echo "TypeScript cannot be fetched here: the types of the studio's page are not checked"; fi

format: $(DEV)
	$(BIN)/ruff check --fix
	$(BIN)/ruff format

verification: $(DEV)
	$(BIN)/python -m pytest tests/verification -n auto -m "slow or not slow" --write-verification

actuators: $(DEV)
	$(BIN)/python docs/actuator_pages.py --pictures

gallery: $(DEV)
	$(BIN)/python docs/gallery.py
	$(BIN)/python docs/notebook_page.py

reference: $(DEV)
	$(BIN)/python docs/reference_pages.py
	$(BIN)/python docs/names_page.py
	$(BIN)/python docs/materials_page.py

dist: $(RUN)
	$(BIN)/python release/dist.py

docs: $(DOCS)
	$(BIN)/python -m sphinx -W --keep-going -b html docs docs/_build/html

bench: $(RUN)
	$(BIN)/python benchmarks/run.py

robustness: $(RUN)
	$(BIN)/python benchmarks/robustness/robustness.py

fuzz: $(DEV)
	$(BIN)/python tests/fuzz/fuzz_all.py 10000
	TURGOR_FUZZ=1000 $(BIN)/python -m pytest tests/fuzz/test_fuzz_tables.py

kills: $(DEV)
	TURGOR_KILLS=200 $(BIN)/python -m pytest tests/kills -m "slow or not slow" --log-cli-level=INFO

truth: $(RUN) requirements/truth.lock
	$(PIP) install -r requirements/truth.lock
	$(BIN)/python benchmarks/truth/truth.py

guidelines: $(DEV)
	$(BIN)/turgor guidelines run --processes 2 --output runs/guidelines || true
	$(BIN)/python docs/guidelines_page.py runs/guidelines

measured: $(DEV)
	$(BIN)/python tests/validation/actuators/measured_page.py runs/measured

fast: $(RUN) requirements/fast.lock
	$(PIP) install -r requirements/fast.lock

lock:
	uv pip compile $(LOCK) -o requirements/run.lock
	uv pip compile $(LOCK) --extra dev -c requirements/run.lock -o requirements/dev.lock
	uv pip compile $(LOCK) --extra docs -c requirements/dev.lock -o requirements/docs.lock
	uv pip compile $(LOCK) --extra fast -c requirements/run.lock -o requirements/fast.lock
	uv pip compile $(LOCK) --group truth -c requirements/run.lock -o requirements/truth.lock

LOCK := pyproject.toml --group build --universal --python-version 3.11 --fork-strategy fewest \
	--upgrade --no-header --no-annotate --quiet

clean:
	rm -rf $(VENV) build dist docs/_build .pytest_cache .mypy_cache .ruff_cache .import_linter_cache .hypothesis
	find src tests benchmarks guidelines -name __pycache__ -type d -prune -exec rm -rf {} +

# Setting up. A .venv that is broken or too old is rebuilt; packages come in at their locked versions, and turgor
# itself and the guidelines as links to their folders src, so that a change there needs no new set-up.
$(RUN): requirements/run.lock pyproject.toml guidelines/pyproject.toml
	@if ! $(BIN)/python -c "import pip, $(NEW_ENOUGH)" >/dev/null 2>&1; then \
	  for p in $(PYTHON) $(if $(PYTHON),,python3 python3.13 python3.12 python3.11 python); do \
	    if $$p -c "$(NEW_ENOUGH)" >/dev/null 2>&1; then found=$$p; break; fi; \
	  done; \
	  if [ -z "$$found" ]; then \
	    echo "turgor needs Python 3.11 or newer; found: $$($(or $(PYTHON),python3) --version 2>&1 | head -1)." >&2; \
	    echo "Install one, or name it: make $(MAKECMDGOALS) PYTHON=/path/to/python3.12" >&2; \
	    exit 1; \
	  fi; \
	  echo "making $(VENV) with $$found ($$($$found --version))"; \
	  $$found -m venv --clear $(VENV); \
	fi
	@echo "installing turgor and its locked versions into $(VENV) (once; a download of about 250 MB)"
	$(PIP) install -r requirements/run.lock
	$(PIP) install --no-deps --no-build-isolation --editable . --editable guidelines
	@touch $@

$(DEV): requirements/dev.lock $(RUN)
	@echo "installing test tools and linters into $(VENV)"
	$(PIP) install -r requirements/dev.lock
	@touch $@

$(DOCS): requirements/docs.lock $(RUN)
	@echo "installing the tools for the documentation into $(VENV)"
	$(PIP) install -r requirements/docs.lock
	@touch $@
