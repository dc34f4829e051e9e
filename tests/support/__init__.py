"""Helpers that tests of more than one folder use: `from support.geometry import box`.

A helper of one folder stays in that folder, and is imported by its full name: `from writers.golden import compare`.
No test module imports another test module. Pytest puts the folder `tests` on the path (`pythonpath` in pyproject.toml);
a program there is run from inside it: `cd tests && python -m bench.run`.
"""
