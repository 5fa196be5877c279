"""The exception of an expression that has no value, and where it is reported."""

from __future__ import annotations

from dataclasses import replace

from ncscope.diagnostics import Diagnostic, Span, diagnostic


class EvaluationError(Exception):
    """An expression has no value here."""

    def __init__(self, item: Diagnostic) -> None:
        super().__init__(item.message)
        self.diagnostic = item


def failure(id: str, span: Span, message: str, hint: str = "") -> EvaluationError:
    """The exception with its diagnostic."""
    return EvaluationError(diagnostic(id, span, message, hint))


def used_at(item: Diagnostic, span: Span) -> Diagnostic:
    """The diagnostic of a macro's text as one of the place that uses the macro, with one note."""
    if item.span is None or item.span.source is span.source:
        return item
    notes = item.notes or (("in the text of the macro", item.span),)
    return replace(item, span=span, notes=notes)
