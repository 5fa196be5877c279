"""Files that are not lists: NC programs (`programs`), tables of poses (`pose_tables`), and what the
machine would answer (`given_tables`)."""

from ncscope.loading.given_tables import load_rows
from ncscope.loading.programs import load_program, subprogram_loader

__all__ = ["load_program", "load_rows", "subprogram_loader"]
