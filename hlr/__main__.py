"""`python -m hlr` is the command line."""

from hlr.cli import main

main()
