"""Files that are not lists: NC programs (`programs`) and tables of poses (`pose_tables`)."""

from ncscope.loading.programs import load_program, subprogram_loader

__all__ = ["load_program", "subprogram_loader"]
