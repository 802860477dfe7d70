# AMP Studio. "make run" and "make test" set up everything they need in .venv; "make" lists the targets.
# PYTHON=python3.13 chooses the interpreter, WORKERS=4 the number of test processes, COV=1 adds coverage,
# TESTS=tests/files the tests to run.

MAKEFLAGS += --no-print-directory
# One more than the processors of the smallest machine: a test in three waits for another process.
WORKERS ?= 3
TESTS ?=
BIN := .venv/bin
LOCK_TOOL := uv==0.13.9
LOCK := build/lock/bin/uv pip compile pyproject.toml --quiet --universal --python-version 3.11 --fork-strategy fewest \
	--generate-hashes --no-emit-index-url --no-emit-find-links --no-annotate --custom-compile-command "make lock" \
	$(if $(UPGRADE),--upgrade)

.DEFAULT_GOAL := help
.PHONY: help run test durations mutants campaign tunings judged slips faults monkey peers peer-grblhal peer-linuxcnc check format schema docs lock bench screenshots man translations wheel bundle windows clean setup setup-run

help: ## this list
	@awk -F ':.*## ' '/^[a-z-]+:.*## / {printf "  make %-11s %s\n", $$1, $$2}' $(MAKEFILE_LIST)

run: setup-run ## set up what is missing and show the program on an example machine
	@$(BIN)/amp-studio demo

test: setup ## set up what is missing and run all tests
	@$(BIN)/python -m pytest -n $(WORKERS) --dist worksteal $(if $(COV),--cov --cov-report=term) $(TESTS)

durations: setup ## run all tests and print the sixty that take longest
	@$(BIN)/python -m pytest -q -n $(WORKERS) --dist worksteal --durations=60 --durations-min=0.5 $(TESTS)

mutants: setup ## change every rule and its findings in every way, and every fact of the manuals, one at a time, and list what no case notices
	@AMP_STUDIO_FULL=1 $(BIN)/python -m pytest -q -s tests/validate/test_rule_mutants.py tests/validate/test_finding_mutants.py tests/manual/test_printed_facts.py

campaign: setup ## generated cases that no run has tried: every property 25 times as often, with another seed each time
	@AMP_STUDIO_FULL=1 $(BIN)/python -m pytest -q -n $(WORKERS) -m hypothesis $(TESTS)
	@AMP_STUDIO_FULL=1 $(BIN)/python -m pytest -q -n $(WORKERS) $(addprefix tests/validate/test_,rules.py any_values.py fix_campaign.py offered_fixes.py fixes.py explanation.py plausible.py slips.py remembered_results.py) $(addprefix tests/sim/test_,german_sentences.py solver.py engines.py frequency_response.py chirps.py hidden_plants.py moved_axes.py without_numba.py tiny_law.py) tests/transfer tests/families/num/test_table_properties.py
	@AMP_STUDIO_FULL=1 $(BIN)/python -m pytest -q tests/families/linuxcnc/test_paths.py tests/families/linuxcnc/test_homing.py
	@! command -v linuxcnc >/dev/null || PYTHONPATH=. $(BIN)/python -m tests.families.linuxcnc.mutated_migrations
	@AMP_STUDIO_FULL=1 $(BIN)/python -m pytest -q -n $(WORKERS) tests/ui/test_memory.py tests/ui/test_screens.py tests/ui/test_watchdog.py tests/bench tests/test_package.py tests/drawing tests/pictures tests/report tests/examples tests/docs tests/cli tests/formats/test_spreadsheet_block.py tests/schema/test_json_schemas.py

judged: setup ## compare the figures of tune for random machines with python-control: JUDGED=30
	@PYTHONPATH=. $(BIN)/python -m tests.sim.tuning_judge $(or $(JUDGED),30)

tunings: setup ## tune 300 random machines and search each on a grid: TUNINGS="300 1" (machines, seed)
	@PYTHONPATH=. $(BIN)/python -m tests.sim.tuning_campaign $(or $(TUNINGS),300 1)

slips: setup ## plant every slip of one value into the examples and print what share brings a finding: SLIPS="--missed" lists the others
	@PYTHONPATH=.:tests/validate $(BIN)/python -m slips $(SLIPS)

faults: setup ## fault campaigns: failing calls, kills, damaged contents, hostile peers; FAULTS="--only journal --share 0.1 --seed 7"
	@AMP_STUDIO_FULL=1 PYTHONPATH=.:tests/validate $(BIN)/python -m tests.faults.run $(FAULTS)
	@$(if $(FAULTS),,AMP_STUDIO_FULL=1 $(BIN)/python -m pytest -q tests/faults/test_monkey.py tests/families/grblhal/test_real_control.py tests/families/grblhal/test_real_description.py)

monkey: setup ## type and click at random in the window of one family: MONKEY="grblhal 7 60 LOG" (seed, seconds, log), or "grblhal --replay LOG"; make faults does it for ten minutes a family
	@PYTHONPATH=. $(BIN)/python -m tests.faults.monkey $(or $(MONKEY),9pc 1 60)

peers: peer-grblhal peer-linuxcnc ## other ends that nobody here wrote: grblHAL from its sources into build/peers, LinuxCNC where apt is: make peers AMP_STUDIO_PEERS=FOLDER

peer-grblhal: ## the firmware alone, which takes half a minute
	@test -d "$(AMP_STUDIO_PEERS)" || { echo "AMP_STUDIO_PEERS=FOLDER says where the sources are"; exit 1; }
	@"$(AMP_STUDIO_PEERS)/grblhal/build.sh" build/peers/grblhal
	@GRBLHAL_FLAGS="-DN_AXIS=5 -DENABLE_BACKLASH_COMPENSATION=1" "$(AMP_STUDIO_PEERS)/grblhal/build.sh" build/peers/grblhal5

peer-linuxcnc: ## LinuxCNC of Debian, and a user that may run it: it refuses root
	@command -v linuxcnc >/dev/null || { command -v apt-get >/dev/null && apt-get install -y --no-install-recommends linuxcnc-uspace; } || \
		{ echo "LinuxCNC is not installed: it comes with apt, as root; its tests are skipped"; exit 0; }
	@! command -v linuxcnc >/dev/null || id cnc >/dev/null 2>&1 || useradd -m cnc

check: setup ## format, lint, types and the import contracts
	@$(BIN)/ruff format --check
	@$(BIN)/ruff check
	@$(BIN)/mypy
	@$(BIN)/mypy scripts
	@$(BIN)/mypy --platform win32 --no-warn-unreachable --cache-dir .mypy_cache/win32
	@$(BIN)/lint-imports --no-cache --no-logo

format: setup ## put the code into the one format and mend what ruff can mend
	@$(BIN)/ruff format
	@$(BIN)/ruff check --fix

schema: setup ## write the JSON Schemas by which an editor completes and checks fact files, rules.yaml and project.yaml
	@$(BIN)/python scripts/write_schemas.py

docs: setup-run build/docs/env/ready ## write the site with the reference of every parameter into build/site, and check its links
	@rm -rf build/docs/source build/site && mkdir -p build/docs/source && cp -R docs/. build/docs/source
	@sed 's#](docs/#](#g; s#](CHANGELOG#](changelog#g' CONTRIBUTING.md >build/docs/source/contributing.md && cp CHANGELOG.md build/docs/source/changelog.md
	@$(BIN)/python scripts/write_reference.py build/docs/source
	@build/docs/env/bin/sphinx-build --quiet --fail-on-warning --keep-going --fresh-env --jobs auto \
		--doctree-dir build/docs/doctrees build/docs/source build/site
	@$(BIN)/python scripts/check_links.py build/site

build/docs/env/ready: requirements/docs.lock
	@rm -rf build/docs/env && $(or $(PYTHON),python3) -m venv build/docs/env
	@build/docs/env/bin/pip install --quiet --disable-pip-version-check --only-binary :all: --require-hashes --no-deps -r $<
	@touch $@

bench: setup ## measure, and print one table
	@$(BIN)/python bench/run.py $(BENCH)

translations: setup ## find the texts of the window that have no translation, and list them
	@$(BIN)/python scripts/translations.py

screenshots: setup ## draw the pictures of the pages, and every page of the window into build/screenshots
	@$(BIN)/python scripts/screenshots.py

man: setup ## write build/amp-studio.1, the man page
	@mkdir -p build && $(BIN)/amp-studio man > build/amp-studio.1

wheel: setup ## build dist/*.whl and the source archive, without the network
	@$(BIN)/python -m build --no-isolation --outdir dist

BUNDLE := build/bundle/env$(if $(FAST),-fast)
bundle: wheel $(BUNDLE)/ready ## one folder that needs no Python, and a package for Debian, in dist; FAST=1 adds machine code for the simulator
	@$(BUNDLE)/bin/pip install --quiet --disable-pip-version-check --no-index --no-deps --force-reinstall dist/amp_studio-*.whl
	@$(BUNDLE)/bin/pyinstaller --noconfirm --log-level WARN --workpath build/bundle/work --distpath build/bundle scripts/bundle/amp-studio.spec
	@sh scripts/bundle/pack.sh build/bundle/amp-studio dist
	@$(BUNDLE)/bin/python scripts/bundle/prove.py build/bundle/amp-studio

windows: wheel ## a zip for Windows without a network: wheels and install.cmd, in dist; not tried on Windows
	@sh scripts/bundle/windows.sh dist $(abspath $(BIN)/python)

$(BUNDLE)/ready: requirements/bundle.lock requirements/run.lock
	@rm -rf $(BUNDLE) && $(or $(PYTHON),python3) -m venv $(BUNDLE)
	@$(BUNDLE)/bin/pip install --quiet --disable-pip-version-check --only-binary :all: --require-hashes --no-deps -r $<
	@$(if $(FAST),$(BUNDLE)/bin/pip install --quiet --disable-pip-version-check --only-binary :all: --require-hashes --no-deps -r requirements/run.lock)
	@touch $@

lock: ## write requirements/*.lock again; UPGRADE=1 takes the newest versions
	@test -x build/lock/bin/uv || { $(or $(PYTHON),python3) -m venv build/lock && build/lock/bin/pip install --quiet $(LOCK_TOOL); }
	@$(LOCK) --extra fast --extra cluster --group dev --output-file requirements/dev.lock
	@$(LOCK) --extra fast --group build --constraint requirements/dev.lock --output-file requirements/run.lock
	@$(LOCK) --group bundle --constraint requirements/dev.lock --output-file requirements/bundle.lock
	@$(subst pyproject.toml,,$(LOCK)) --group docs --output-file requirements/docs.lock

clean: ## remove everything that make made, .venv too
	rm -rf .venv build dist .pytest_cache .mypy_cache .ruff_cache .hypothesis .import_linter_cache .coverage
	find . -name __pycache__ -type d -prune -exec rm -rf {} +

setup:
	@sh scripts/bootstrap.sh dev

setup-run:
	@sh scripts/bootstrap.sh run
