"""Pictures as files: which drawing a picture takes, and its title."""

from __future__ import annotations

from ncscope.inspection import inspect
from ncscope.kinematics.universal import UniversalKinematics
from ncscope.trajectory import Trajectory
from ncscope.views.pictures.chain import chain_scene
from ncscope.views.pictures.path import tool_path


def path_picture(result: Trajectory, name: str, form: str) -> bytes:
    """The path of a run and its axis curves. form: png, svg or html; name: of the program."""
    path, inspection = tool_path(result), inspect(result)
    title = f"{name}: tool tip in the machine system, {int(result.end.sum()):,} motion blocks"
    if form == "html":
        from ncscope.views.pictures.page import path_page

        return path_page(result, inspection, path, title)
    from ncscope.views.pictures.image import path_image

    return path_image(result, inspection, path, title, form)


def chain_picture(model: UniversalKinematics, name: str, tool_length: float, form: str) -> bytes:
    """The chain of a machine, all axes at 0. name: of the machine; tool_length: mm."""
    scene = chain_scene(model, tool_length)
    title = f"{name}: {scene.name}"
    kind = "RTCP" if model.rtcp else "complete transformation"
    note = (
        f"all axes at 0; directions as entered; programming mode {model.mode}, {kind}; "
        f"tool length {tool_length:g} mm"
    )
    if model.chain.linkage is not None:
        note += "; the linkage is not drawn"
    if form == "html":
        from ncscope.views.pictures.page import chain_page

        return chain_page(scene, title, note)
    from ncscope.views.pictures.chain_image import chain_image

    return chain_image(scene, title, note, form)
