#!/usr/bin/env bash
# Reads the command's .vti and .pvd files with VTK: check_vtk.sh COMMAND
# Exits with 77 where no Python has VTK and NumPy (Debian: python3-vtk9, python3-numpy).
set -euo pipefail
has_vtk() { "$1" -c 'import numpy, vtkmodules.vtkIOXML' 2>/dev/null; }
if has_vtk python3; then
  python=python3
elif has_vtk /usr/bin/python3; then
  python=/usr/bin/python3
else
  echo "VTK's Python bindings (python3-vtk9) or NumPy are not installed: skipped"
  exit 77
fi
exec "$python" "$(dirname "$0")/check_vtk.py" "$1"
