# `make report` sets everything up and writes the validation report; `make test` sets everything up and tests.
.DEFAULT_GOAL := help
SHELL := /bin/sh
CORES ?= $(shell nproc 2>/dev/null || echo 1)
STUDY ?= config/study.yaml
MAP_RUNS ?= 64
MAP_MINUTES ?= 20
export PATH := $(CURDIR)/.venv/bin:$(PATH)
VENV := .venv
BIN := $(VENV)/bin
REPLACE ?= 0
TRUST_MODELS ?= 0
SNAKEMAKE = sh workflow/setup/locked.sh $(BIN)/snakemake --config study=$(STUDY) replace=$(REPLACE) trust_models=$(TRUST_MODELS) --profile workflow/profiles/default --cores $(CORES)
SYSTEM_PACKAGES := gfortran calculix-ccx chromium poppler-utils

.PHONY: help report check map test lint verify reference mesh-study hierarchy hard-passes bench docs test-pythons test-cluster test-robustness clean

help: ## Show this list
	@awk -F':.*## ' '/^[a-z-]+:.*## /{printf "make %-16s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

report: $(BIN)/.installed ## Set up, run STUDY and write reports/<its name>/index.html and report.pdf
	@$(SNAKEMAKE)
	@$(BIN)/tread-validate assessment $(STUDY)

check: $(BIN)/.installed ## The same without the report; 1 where the baseline moved or an assessment flipped, 3 without anything compared; of one model or some cases alone with MODEL=paper, CASES="ID ID"
ifeq ($(strip $(MODEL)$(CASES)),)
	@$(SNAKEMAKE) checked
	@$(BIN)/tread-validate assessment $(STUDY) --gate
else
	@$(BIN)/tread-validate check-model $(STUDY) $(MODEL:%=--model %) $(CASES:%=--case %) --jobs $(CORES) $(if $(filter 1,$(TRUST_MODELS)),--trust-models)
endif

test: $(BIN)/.installed-dev system-packages lint ## Set up, then check style, types, layers and workflow, and run the tests
	@$(BIN)/pytest -m "not heavy" -n $(CORES) --dist worksteal -q

lint: $(BIN)/.installed-dev ## Style, types, import layers, workflow
	@$(BIN)/ruff check .
	@$(BIN)/ruff format --check --quiet .
	@$(BIN)/mypy
	@$(BIN)/lint-imports --no-logo --no-cache
	@$(BIN)/snakefmt --check Snakefile workflow
	@$(BIN)/snakemake --lint --quiet

verify: $(BIN)/.installed-dev system-packages ## The heavy verification: fine meshes, long convergence series
	@$(BIN)/pytest -m heavy -q

reference: $(BIN)/.installed gfortran ## Run the study's FE engine for every case whose reference is missing, stale or of other code (REPLACE=1)
	@$(SNAKEMAKE) reference

mesh-study: $(BIN)/.installed gfortran ## Three meshes of one typical case of every kind of path and block, extrapolated
	@$(SNAKEMAKE) mesh_study

hierarchy: $(BIN)/.installed ## Run the model hierarchy anew: error and cost of every level, effects, sensitivity
	@$(SNAKEMAKE) hierarchy

map: $(BIN)/.installed gfortran ## Where each model may be believed: FE over the dimensionless groups; goes on where it was
	@$(BIN)/tread-validate map $(STUDY) --runs $(MAP_RUNS) --minutes $(MAP_MINUTES) --jobs $(CORES) -o results/map

hard-passes: $(BIN)/.installed gfortran ## Passes that are hard on models and FE engine: both run, docs/hard_passes.md written anew
	@$(BIN)/python examples/hard_passes/hard_passes.py docs/hard_passes.md
	@$(BIN)/python examples/hard_passes/sliding.py docs/hard_passes.md

# material_pyvisco.py needs packages of its own (benchmarks/requirements-pyvisco.txt) and is run by hand
bench: $(BIN)/.installed-dev system-packages ## Measure speed and memory
	@for file in $(filter-out benchmarks/material_pyvisco.py,$(wildcard benchmarks/*.py)); do echo "== $$file"; $(BIN)/python $$file || exit 1; done

# its pages tell the paper's study and name its cases; the report of another study is its own page
docs: ASKED := $(STUDY)
docs: override STUDY := config/study.yaml
docs: $(BIN)/.installed-dev report ## Build the guide (of the paper's study, whatever STUDY is), links checked: build/docs/index.html
	@$(BIN)/python docs/generate.py
	@$(BIN)/mkdocs build --strict --quiet
	@[ "$(ASKED)" = "$(STUDY)" ] || echo "The guide is that of $(STUDY): its pages name that study's cases. $(ASKED) has a report: make report"
	@echo "The guide: build/docs/index.html"

test-pythons: $(BIN)/.installed-dev system-packages ## The small study on every other Python found (3.11 to 3.13): same decks, tables within noise
	@WITH_PYTHONS=1 $(BIN)/pytest -q tests/verification/test_python_versions.py

test-cluster: $(BIN)/.installed-dev ## A 200-run study through a real Slurm on this machine (root)
	@sh workflow/setup/packages.sh slurm-wlm munge gfortran
	@$(BIN)/python tests/workflow/slurm/check_cluster.py

test-robustness: $(BIN)/.installed-dev ## Kill -9, two runs at once, full and read-only disks (root); damaged files
	@$(BIN)/python tests/workflow/robustness/check_robustness.py
	@$(BIN)/pytest -m heavy -q -rP tests/unit/fuzz

clean: ## Remove what the pipeline made (not the virtual environment)
	@rm -rf results logs reports/*.html .snakemake
	@find reports -mindepth 2 -maxdepth 2 ! -name baseline -exec rm -rf {} +
	@find fe_inputs -mindepth 1 -maxdepth 1 -type d -exec rm -rf {} +

$(BIN)/.installed: pyproject.toml constraints.txt workflow/setup/environment.sh
	@sh workflow/setup/environment.sh $(VENV) .
	@touch $@

$(BIN)/.installed-dev: pyproject.toml constraints.txt workflow/setup/environment.sh
	@sh workflow/setup/environment.sh $(VENV) '.[dev]'
	@touch $@ $(BIN)/.installed

.PHONY: system-packages gfortran
system-packages:
	@sh workflow/setup/packages.sh $(SYSTEM_PACKAGES)

gfortran:
	@sh workflow/setup/packages.sh gfortran
