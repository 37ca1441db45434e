# `make help` lists the targets. All that is needed: Rust (with clippy and rustfmt for the checks),
# Python 3.10 or newer, make; valgrind for `make count`. Everything is installed into .venv/ inside this folder.

PYTHON ?= python3
VENV ?= .venv
# A PyTorch package index, such as https://download.pytorch.org/whl/cpu; empty: pip's own choice.
TORCH_INDEX_URL ?=
# Size of the comparisons, smoke, small or full; see training/configs/budgets/. Folder of that of `make demo`.
BUDGET ?= small
OUT ?= runs/demo
# Folders of `make turn` and `make reach`.
TURN_OUT ?= runs/turn-comparison
REACH_OUT ?= runs/reach-comparison

VENV_PYTHON := $(abspath $(VENV))/bin/python
MATURIN := env -u CONDA_PREFIX VIRTUAL_ENV=$(abspath $(VENV)) $(VENV_PYTHON) -m maturin
PIP := $(VENV_PYTHON) -m pip --disable-pip-version-check
RUST := $(shell find rust -name '*.rs' -o -name '*.toml') Cargo.toml Cargo.lock
EXTENSION := $(wildcard magworm_gym/_magworm*.so)
WHEEL_VENV := target/wheel-venv
COMPARE = $(VENV_PYTHON) training/evaluate.py --budget $(BUDGET)
# Results of this size are those of README and docs/, which are filled from them.
KEEP = $(if $(filter small,$(BUDGET)),--keep docs/results/$(1).json && $(VENV_PYTHON) docs/results.py)

export PYO3_PYTHON := $(VENV_PYTHON)

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.NOTPARALLEL:
.PHONY: help demo turn reach policies validate paper turning-map study-error study-stability study-growth study-needs study-peak identify identify-joint test bench count count-write wheel lint format docs clean install \
	lint-layers lint-rust lint-python test-rust test-nightly test-python test-docs test-wheel \
	count-program need-cargo need-python need-rust-checks need-valgrind force

##@ Main

demo: install-train  ## train a controller, compare it with the belts, print the table last
	$(COMPARE) crawl --out $(OUT) $(call KEEP,crawl)

turn: install-train  ## train turning, compare it with belts and two magnets, a quarter of an hour
	$(COMPARE) turn --out $(TURN_OUT) $(call KEEP,turn)

reach: install-train  ## the same for crawling to a point
	$(COMPARE) reach --out $(REACH_OUT) $(call KEEP,reach)

policies: install-train  ## train the policies that come with the package again, a quarter of an hour
	$(VENV_PYTHON) -m training.ship_policies

validate: install-test need-cargo  ## compare the simulator with exact solutions, write docs/validation.md
	$(VENV_PYTHON) -m studies measure validation
	$(VENV_PYTHON) -m studies render validation

paper: install-test  ## simulate the paper's experiments again: docs/paper.md beside its figures
	$(VENV_PYTHON) -m studies measure paper
	$(VENV_PYTHON) -m studies render paper

turning-map: install-test  ## how far a pass beside the robot turns it, when it tips over: docs/turning.md
	$(VENV_PYTHON) -m studies measure turning
	$(VENV_PYTHON) -m studies render turning

study-error: install-test  ## error against run time: docs/performance.md, docs/speed.md; minutes
	$(VENV_PYTHON) -m studies measure error
	$(VENV_PYTHON) -m studies render error speed

study-growth: install-test  ## how cost grows with environments, nodes, magnets: docs/growth.md; minutes
	$(VENV_PYTHON) -m studies measure growth
	$(VENV_PYTHON) -m studies render growth

study-needs: need-valgrind install-test count-program  ## what each effect of a scene costs: docs/needs.md
	$(VENV_PYTHON) -m studies measure needs
	$(VENV_PYTHON) -m studies render needs error speed

study-peak: need-valgrind install-test count-program  ## arithmetic of a step against the core's peak: docs/peak.md
	cargo build --release --package magworm-py --example peak
	$(VENV_PYTHON) -m studies measure peak
	$(VENV_PYTHON) -m studies render peak

study-stability: install-test  ## stiff and extreme scenes, the explicit scheme's largest step: docs/stability.md
	$(VENV_PYTHON) -m studies measure stability
	$(VENV_PYTHON) -m studies render stability

test: lint test-rust test-docs test-wheel test-python  ## lint and all tests; CI runs `make test count`

identify: install-test  ## identify the presets again, an hour: docs/identification/, rust/magworm/scenes/
	for problem in paper-3-simulation paper-joint; do \
		$(dir $(VENV_PYTHON))magworm identify studies/identification/$$problem.toml \
			--out runs/identify/$$problem && \
		$(VENV_PYTHON) -m studies.identification.settle_presets $$problem && \
		$(MAKE) install || exit 1; \
	done

identify-joint: install-test  ## one robot for all figures, from blind starts, for hours: docs/identification/joint.md
	$(VENV_PYTHON) -m studies.identification.joint --problems studies/identification/paper-joint*.toml

##@ Parts

install: install-test  ## .venv with the extension and all extras
lint: lint-layers lint-rust lint-python  ## layers, formatting, clippy, ruff, import-linter, mypy, stubs
bench: install-test  ## time of a wrench, a step, and the throughput of environments
	cargo bench --package magworm
	$(VENV_PYTHON) -m studies measure speed --out runs/bench/speed.csv

count: need-valgrind count-program  ## instructions of steps and wrenches beside the committed ones; needs valgrind
	$(PYTHON) -m studies.needs.counts

count-write: need-valgrind count-program  ## commit the instructions counted now
	$(PYTHON) -m studies.needs.counts --write

wheel: $(VENV)/.made  ## release wheel in dist/
	rm -f dist/*.whl
	$(MATURIN) build --release --out dist

format: need-rust-checks install-test  ## format Rust and Python, mend what ruff can
	cargo fmt --all
	$(VENV_PYTHON) -m ruff check --fix .
	$(VENV_PYTHON) -m ruff format .

docs: install-test  ## write tables and numbers of README.md and docs/ that come from the simulator and from docs/results/
	$(VENV_PYTHON) docs/results.py

clean:  ## remove everything that was built or installed; results in runs/ stay
	rm -rf $(VENV) target dist .pytest_cache .mypy_cache .ruff_cache magworm_gym/_magworm*.so
	find . -name __pycache__ -type d -not -path './.git/*' -prune -exec rm -rf {} +

help:  ## this list
	@awk 'BEGIN { FS = ":.*## " } \
		/^##@/ { printf "\n%s\n", substr($$0, 5) } \
		/^[a-z-]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' $(firstword $(MAKEFILE_LIST))
	@printf '\nVariables: PYTHON=%s  VENV=%s  BUDGET=%s  OUT=%s\n' '$(PYTHON)' '$(VENV)' '$(BUDGET)' '$(OUT)'
	@echo '  TORCH_INDEX_URL=https://download.pytorch.org/whl/cpu installs a PyTorch without CUDA.'

##@ Checks, one by one

lint-layers: need-python  ## modules of the simulator against the layers of ARCHITECTURE.md
	$(PYTHON) .ci/layers.py

lint-rust: need-rust-checks $(VENV)/.made  ## cargo fmt, clippy
	cargo fmt --all --check
	cargo clippy --workspace --all-targets -- --deny warnings

lint-python: install-test  ## ruff, import-linter, mypy, stubtest
	$(VENV_PYTHON) -m ruff check .
	$(VENV_PYTHON) -m ruff format --check .
	$(dir $(VENV_PYTHON))lint-imports
	$(VENV_PYTHON) -m mypy
	$(VENV_PYTHON) -m mypy.stubtest --mypy-config-file pyproject.toml magworm_gym._magworm

test-rust: need-cargo  ## cargo test
	cargo test

test-nightly: need-cargo  ## 100,000 random extreme scenes and rubbers, ten million steps in single precision
	PROPTEST_CASES=100000 cargo test --test random_scenes extreme
	PROPTEST_CASES=100000 cargo test --test validation relaxing_stability
	cargo test --test long_runs -- --ignored

test-docs: need-cargo install-test  ## cargo doc, tables and numbers of README.md and docs/
	RUSTDOCFLAGS='--deny warnings' cargo doc --no-deps --package magworm
	$(VENV_PYTHON) docs/results.py --check

test-wheel: wheel  ## the wheel in an empty environment: needs numpy and gymnasium only
	rm -rf $(WHEEL_VENV)
	$(PYTHON) -m venv $(WHEEL_VENV)
	$(WHEEL_VENV)/bin/python -m pip --disable-pip-version-check install --quiet dist/*.whl
	$(WHEEL_VENV)/bin/python -I -W error .ci/check_wheel.py

test-python: install-test  ## pytest
	$(VENV_PYTHON) -m pytest

# Stamps: a target below is remade when what it depends on is newer.

$(VENV)/.made: | need-python
	@$(PYTHON) -m venv $(VENV) \
		|| { echo 'make: $(PYTHON) cannot make a virtual environment; on Debian and Ubuntu install python3-venv' >&2; exit 1; }
	$(PIP) install 'maturin>=1.9,<2'
	@touch $@

# Also where the extension is gone though the stamp is there.
$(VENV)/.built: $(VENV)/.made $(RUST) pyproject.toml $(if $(EXTENSION),,force) | need-cargo
	$(MATURIN) develop --release
	@touch $@

# The package is installed by now: pip adds only what the extra asks for.
.PHONY: install-train install-test
install-train: $(VENV)/.built $(VENV)/.train
install-test: $(VENV)/.built $(VENV)/.test

$(VENV)/.train $(VENV)/.test: $(VENV)/.%: pyproject.toml | $(VENV)/.built
	$(if $(TORCH_INDEX_URL),$(PIP) install --index-url '$(TORCH_INDEX_URL)' 'torch>=2.4')
	$(PIP) install 'magworm-gym[$*]'
	@touch $@

# In the package of the extension, whose build has compiled the simulator already.
count-program: need-cargo $(VENV)/.made
	cargo build --release --package magworm-py --example count

need-valgrind:
	@command -v valgrind >/dev/null \
		|| { echo 'make: valgrind is missing: on Debian and Ubuntu install valgrind' >&2; exit 1; }

need-cargo:
	@command -v cargo >/dev/null \
		|| { echo 'make: cargo is missing: install Rust 1.88 or newer from https://rustup.rs' >&2; exit 1; }

need-rust-checks: need-cargo
	@cargo fmt --version >/dev/null 2>&1 \
		|| { echo 'make: rustfmt is missing: run "rustup component add rustfmt"' >&2; exit 1; }
	@cargo clippy --version >/dev/null 2>&1 \
		|| { echo 'make: clippy is missing: run "rustup component add clippy"' >&2; exit 1; }

need-python:
	@command -v $(PYTHON) >/dev/null \
		|| { echo 'make: $(PYTHON) is missing: install Python 3.10 or newer, or name one, as in "make PYTHON=python3.12"' >&2; exit 1; }
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 10))' \
		|| { echo 'make: $(PYTHON) is older than 3.10: name a newer one, as in "make PYTHON=python3.12"' >&2; exit 1; }

force:
