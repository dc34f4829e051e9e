"""The module of a script in a process that it has started."""

from hlr.source.cad.child_process import run_again

run_again(globals())
