"""No test depends on how fast the machine is: hypothesis measures no deadlines here."""

import pytest
from hypothesis import settings

from ncscope.execution import loop

settings.register_profile("ncscope", deadline=None)
settings.load_profile("ncscope")


@pytest.fixture
def stepped(monkeypatch):
    """The lines that the step lane takes."""
    lines, execute = [], loop.execute

    def counted(machine, state, block):
        lines.append(block.span.line)
        return execute(machine, state, block)

    monkeypatch.setattr(loop, "execute", counted)
    return lines
