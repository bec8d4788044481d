#!/usr/bin/env bash
# Reads the command's .vti and .pvd files with VTK: check_vtk.sh COMMAND
# Exits with 77 where no Python has VTK and NumPy (Debian: python3-vtk9, python3-numpy).
set -euo pipefail
if ! python=$("$(dirname "$0")/find_python.sh" numpy vtkmodules.vtkIOXML); then
  echo "VTK's Python bindings (python3-vtk9) or NumPy are not installed: skipped"
  exit 77
fi
exec "$python" "$(dirname "$0")/check_vtk.py" "$1"
