#!/usr/bin/env bash
# Reads the command's .vti and .pvd files with VTK: check_vtk.sh COMMAND
# Exits with 77 where no Python has VTK and NumPy (Debian: python3-vtk9, python3-numpy).
set -euo pipefail
for python in python3 /usr/bin/python3; do
  "$python" -c 'import numpy, vtkmodules.vtkIOXML' 2>/dev/null || continue
  exec "$python" "$(dirname "$0")/check_vtk.py" "$1"
done
echo "VTK's Python bindings (python3-vtk9) are not installed: skipped"
exit 77
