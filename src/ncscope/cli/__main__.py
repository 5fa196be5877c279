"""`python -m ncscope.cli`."""

from ncscope.cli import main

main()
