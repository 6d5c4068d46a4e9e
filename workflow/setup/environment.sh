#!/bin/sh
# Make the virtual environment and install the package in it, every version pinned by constraints.txt.
# Usage: environment.sh FOLDER REQUIREMENT
set -eu
folder=$1
requirement=$2

python=
for candidate in python3.11 python3.12 python3.13 python3; do
    if command -v "$candidate" >/dev/null 2>&1 &&
        "$candidate" -c 'import sys; sys.exit(sys.version_info < (3, 11))' 2>/dev/null; then
        python=$candidate
        break
    fi
done
if [ -z "$python" ]; then
    echo "Python 3.11 or newer is needed: install it first (Debian: apt-get install python3)" >&2
    exit 2
fi
if ! "$python" -c 'import ensurepip, venv' 2>/dev/null; then
    sh "$(dirname "$0")/packages.sh" python3-venv
fi
if [ ! -x "$folder/bin/python" ]; then
    echo "Making the virtual environment $folder"
    "$python" -m venv "$folder"
fi
echo "Installing pinned packages (a few minutes the first time)"
"$folder/bin/python" -m pip install --quiet --disable-pip-version-check --constraint constraints.txt \
    setuptools wheel
"$folder/bin/python" -m pip install --quiet --disable-pip-version-check --no-build-isolation \
    --constraint constraints.txt --editable "$requirement"
"$folder/bin/python" workflow/setup/compile_kernels.py config/study.yaml
