#!/usr/bin/python3
"""Octave reads the table: the parameters and the covariance of each patch are the same numbers there, but for
the last bit, which textscan may read otherwise."""
import pathlib
import shutil
import subprocess
import sys

from consumer import NOT_PROVEN, SET, export, needed

np = needed("numpy", "python3-numpy")
from patch_set import read  # noqa: E402

SCRIPT = """
file = fopen('{file}'); names = strsplit(fgetl(file), ',');
format = [repmat('%s', 1, 5), repmat('%f', 1, numel(names) - 5)];
table = textscan(file, format, 'Delimiter', ',');
column = @(name) table{{find(strcmp(names, name))}};
for row = 1:numel(table{{1}})
  printf('%s %d %.17g %.17g %.17g %d\\n', table{{1}}{{row}}, column('size')(row), column('c_x')(row), column('sigma_c_z')(row),
         column('cov_1_2')(row), isnan(column('cov_11_11')(row)));
end
"""

octave = shutil.which("octave-cli")
if not octave:
    print("NOT PROVEN: octave-cli is not installed (Debian package octave)")
    sys.exit(NOT_PROVEN)
file = export("csv", "set.csv")
ran = subprocess.run([octave, "--norc", "--eval", SCRIPT.format(file=file)], capture_output=True, text=True, check=True,
                     env={"HOME": str(pathlib.Path(file).parent), "PATH": "/usr/bin:/bin"})
for line, patch in zip(ran.stdout.splitlines(), read(SET), strict=True):
    name, size, c_x, sigma, covariance, short = line.split()
    assert name == patch["id"] and int(size) == len(patch["sigma"]) and int(short) == (int(size) < 11)
    expected = patch["c"][0], patch["sigma"][-1], patch["covariance"][0, 1]
    assert np.allclose([float(c_x), float(sigma), float(covariance)], expected, rtol=1e-15, atol=0)
