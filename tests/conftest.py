"""No test depends on how fast the machine is: hypothesis measures no deadlines here."""

from hypothesis import settings

settings.register_profile("ncscope", deadline=None)
settings.load_profile("ncscope")
