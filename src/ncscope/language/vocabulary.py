"""The words that are neither # commands nor G functions: one table, each with its kind.

The kinds are those of `commands`: `modelled`, `no effect` (on positions) or `refused` (by name).
A name that ends in a dot is a group of variables. Source: TF5200 programming manual.
"""

from __future__ import annotations

from typing import NamedTuple


class Entry(NamedTuple):
    """A word as it is written, what the channel does with it, and what it is for."""

    name: str
    kind: str
    purpose: str


# fmt: off
WORDS: tuple[Entry, ...] = (
    Entry("%", "modelled", "Header of a main program, or with L of a local subprogram."),
    Entry("/", "modelled", "Block that is skipped while its skip level is on."),
    Entry("N", "modelled", "Block number, label and aim of jumps."),
    Entry('"..."', "modelled", "Macro: its text, or its use."),
    Entry("P", "modelled", "Parameter."),
    Entry("@P", "modelled", "Parameter of a cycle."),
    Entry("@X", "modelled", "Main axis of the plane, inside a cycle; also @Y and @Z."),
    Entry("@I", "modelled", "Centre word of the plane, inside a cycle; also @J and @K."),
    Entry("@S", "no effect", "Speed of the main spindle, inside a cycle."),
    Entry("$IF", "modelled", "Executes blocks on a condition."),
    Entry("$ELSEIF", "modelled", "Begins another branch of $IF with its own condition."),
    Entry("$IFELSE", "modelled", "Another spelling of $ELSEIF."),
    Entry("$ELSE", "modelled", "Begins the branch for the condition that is not met."),
    Entry("$ENDIF", "modelled", "Ends $IF."),
    Entry("$SWITCH", "modelled", "Chooses one of several branches by a value."),
    Entry("$CASE", "modelled", "Begins a branch of $SWITCH."),
    Entry("$DEFAULT", "modelled", "Begins the branch for all other values."),
    Entry("$ENDSWITCH", "modelled", "Ends $SWITCH."),
    Entry("$FOR", "modelled", "Loop that counts."),
    Entry("$ENDFOR", "modelled", "Ends $FOR."),
    Entry("$WHILE", "modelled", "Loop that tests first."),
    Entry("$ENDWHILE", "modelled", "Ends $WHILE."),
    Entry("$DO", "modelled", "Loop that tests last."),
    Entry("$ENDDO", "modelled", "Ends $DO; goes on while the condition is met."),
    Entry("$REPEAT", "modelled", "Loop that tests last."),
    Entry("$UNTIL", "modelled", "Ends $REPEAT; stops when the condition is met."),
    Entry("$BREAK", "modelled", "Leaves a loop or $SWITCH."),
    Entry("$CONTINUE", "modelled", "Goes on with the next pass of a loop."),
    Entry("$GOTO", "modelled", "Jumps to a label."),
    Entry("L", "modelled", "Calls a subprogram file."),
    Entry("LL", "modelled", "Calls a local subprogram."),
    Entry("L CYCLE", "modelled", "Calls a cycle file with parameters."),
    Entry("LL CYCLE", "modelled", "Calls a local cycle with parameters."),
    Entry("L SEQUENCE", "modelled", "Executes a part of a program again."),
    Entry("M00", "no effect", "Stops until the operator goes on."),
    Entry("M01", "no effect", "Stops when the operator has asked for it."),
    Entry("M02", "modelled", "Ends the program."),
    Entry("M03", "no effect", "Turns the spindle clockwise."),
    Entry("M04", "no effect", "Turns the spindle counter-clockwise."),
    Entry("M05", "no effect", "Stops the spindle."),
    Entry("M06", "modelled", "Calls the subprogram that is configured for it."),
    Entry("M17", "modelled", "Returns from a subprogram."),
    Entry("M19", "no effect", "Positions the spindle."),
    Entry("M29", "modelled", "Returns from a subprogram."),
    Entry("M30", "modelled", "Ends the program."),
    Entry("M40", "no effect", "Chooses a gear of the spindle; also M41 to M45."),
    Entry("M", "no effect", "Switches something that the machine builder has defined."),
    Entry("H", "no effect", "Switches something that the machine builder has defined."),
    Entry("T", "modelled", "Prepares a tool."),
    Entry("D", "modelled", "Selects the data of a tool."),
    Entry("F", "modelled", "Feed."),
    Entry("E", "no effect", "Feed at the end of the block."),
    Entry("R", "modelled", "Radius of an arc."),
    Entry("S", "no effect", "Speed of a spindle."),
    Entry("S.POS", "no effect", "Position of the spindle."),
    Entry("S.OFFSET", "no effect", "Start angle of a thread."),
    Entry("INDP_SYN", "refused", "Moves an axis on its own and waits for it."),
    Entry("INDP_ASYN", "refused", "Moves an axis on its own."),
    Entry("OSC", "refused", "Oscillates an axis."),
    Entry("COMP", "refused", "Compensates errors of an axis."),
    Entry("DIST_CTRL", "refused", "Holds a distance by a sensor."),
    Entry("OVERRIDE", "refused", "Sets the override of an axis."),
    Entry("DYNAMIC", "refused", "Weights the dynamics of an axis."),
    Entry("LIFT", "refused", "Lifts an axis between two motions."),
    Entry("LIFT_START", "refused", "Begins the lifting of an axis."),
    Entry("LIFT_END", "refused", "Ends the lifting of an axis."),
    Entry("SYNC IN", "refused", "Synchronises an axis on the path."),
    Entry("SYNC OUT", "refused", "Ends the synchronisation of an axis."),
    Entry("POLY", "refused", "Moves an axis along a polynomial."),
    Entry("SET_POSITION", "refused", "Gives the position of an axis a new value."),
    Entry("MC_HOME", "refused", "Motion function of the PLC standard."),
    Entry("MC_MOVEABSOLUTE", "refused", "Motion function of the PLC standard."),
    Entry("MC_MOVEADDITIVE", "refused", "Motion function of the PLC standard."),
    Entry("MC_MOVERELATIVE", "refused", "Motion function of the PLC standard."),
    Entry("MC_MOVESUPERIMPOSED", "refused", "Motion function of the PLC standard."),
    Entry("MC_MOVEVELOCITY", "refused", "Motion function of the PLC standard."),
    Entry("MC_STOP", "refused", "Motion function of the PLC standard."),
    Entry("MC_GEARIN", "refused", "Motion function of the PLC standard."),
    Entry("MC_GEAROUT", "refused", "Motion function of the PLC standard."),
    Entry("MC_PHASING", "refused", "Motion function of the PLC standard."),
    Entry("MC_TOUCHPROBE", "refused", "Motion function of the PLC standard."),
    Entry("V.A.", "modelled", "Variables of the axes."),
    Entry("V.G.", "modelled", "Variables of the channel."),
    Entry("V.P.", "modelled", "Variables of the program."),
    Entry("V.S.", "modelled", "Variables that outlive a program."),
    Entry("V.L.", "modelled", "Variables of one program level and the levels below."),
    Entry("V.CYC.", "modelled", "Variables of a cycle."),
    Entry("V.E.", "modelled", "Variables of the PLC."),
    Entry("V.TOOL.", "refused", "Data of the tool management."),
    Entry("V.TLM.", "refused", "Tool life."),
    Entry("V.SPDL.", "refused", "Variables of the spindles."),
    Entry("V.RTA.", "refused", "Values of an axis at run time."),
    Entry("V.RTG.", "refused", "Values of the channel at run time."),
    Entry("V.I.", "refused", "Variables of the interpolator."),
    Entry("V.CH.", "refused", "Variables of another channel."),
    Entry("V.SPDL_PROG.", "refused", "Variables of the programmed spindle."),
)
# fmt: on

_BY_NAME = {entry.name: entry for entry in WORDS}


def word_entry(name: str) -> Entry | None:
    """The row of a word; case does not count.

    >>> word_entry("mc_home").kind
    'refused'
    """
    return _BY_NAME.get(name.upper())


def axis_commands() -> frozenset[str]:
    """The keywords that make `X[KEYWORD ..]` a command."""
    first = next(i for i, entry in enumerate(WORDS) if entry.name == "INDP_SYN")
    last = next(i for i, entry in enumerate(WORDS) if entry.name == "V.A.")
    return frozenset(entry.name.split()[0] for entry in WORDS[first:last])
