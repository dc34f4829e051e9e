# The tasks of every day: `just` lists them, CONTRIBUTING.md explains them.

set positional-arguments

# A profile of the kernel that is built in seconds after a change, and takes two to three times as long to run.
export SETUPTOOLS_RUST_CARGO_PROFILE := "quick"

# List the tasks
default:
    @just --list --unsorted

# Install the package from this tree, once: Python takes effect at once, Rust after `just build`
setup:
    pip install --editable '.[dev]'

# Build the kernel after a change of Rust
build:
    python -W ignore -c 'from setuptools import setup; setup()' --quiet build_rust --inplace

# Run the tests that are given, or all: just test tests/hard/test_terrain.py -k border
test *arguments:
    pytest "$@"

# Run the quick tests, in about a minute
fast *arguments:
    pytest -m 'not slow' "$@"

# Run the tests of the kernel: just rust, just rust sweep
rust *arguments:
    cd hlr/kernel && cargo test --quiet --profile quick --workspace --lib --tests "$@"

# Check that the fuzz targets compile, and write their lock file anew where crates have changed
fuzz:
    cd hlr/kernel/fuzz && cargo check --quiet

# Check style and types as the gate does
lint:
    ruff check .
    ruff format --check .
    mypy hlr cli
    cd hlr/kernel && cargo fmt --all --check
    cd hlr/kernel && cargo clippy --quiet --workspace --all-targets -- -D warnings

# Put Python and Rust into the project's format
format:
    ruff check --fix .
    ruff format .
    cd hlr/kernel && cargo fmt --all

# Measure beside other programs, on a release build (`pip install .`): just bench --only svg,kernel
bench *arguments:
    cd tests && python -m bench.run "$@"

# Draw the expected files and pictures anew; look at each before it is committed
goldens:
    HLR_GOLDEN=write pytest tests/writers
    pytest tests/hard --draw
    git status --short tests/golden tests/hard/pictures

# Build the site of the documentation into build/site
docs:
    pip install --quiet --editable '.[docs]'
    sphinx-build -W -c .ci/docs . build/site

# Run the whole gate: a fresh environment, the wheel, all checks, all tests; some ten minutes
gate:
    .ci/run
