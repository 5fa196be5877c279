"""Random programs against a second model: formula 1.2 as 4x4 matrices, rule 1.3 for the state.

The model shares no code with the product. It holds the level-absolute values `a` of the top level.
"""

import numpy as np
import pytest

import ncscope


def shift(v):
    matrix = np.eye(4)
    matrix[:3, 3] = v
    return matrix


def turn(axis, angle):
    s, c = np.sin(np.radians(angle)), np.cos(np.radians(angle))
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    matrix = np.eye(4)
    matrix[i, i] = matrix[j, j] = c
    matrix[i, j], matrix[j, i] = -s, s
    return matrix


ORDER = ("BCS", "ACS", "CS", "named")


class Model:
    def __init__(self):
        self.scale = np.ones(3)
        self.centre, self.angle, self.plane = (0.0, 0.0), None, 0
        self.mirror, self.mirror_g92 = np.ones(3), np.ones(3)
        self.g92 = [np.zeros(3)]
        self.pset = [np.zeros(3)]
        self.frames = [np.eye(4)]
        self.kinds = ["base"]
        self.named = []
        self.selected = 0
        self.a = np.zeros(3)

    def contour(self):
        matrix = np.diag([*self.scale, 1.0])
        if self.angle is not None:
            c = np.zeros(3)
            c[(self.plane + 1) % 3], c[(self.plane + 2) % 3] = self.centre
            matrix = shift(c) @ turn(self.plane, self.angle) @ shift(-c) @ matrix
        return np.diag([*self.mirror, 1.0]) @ matrix

    def offset(self, k):
        return self.g92[k] * self.mirror_g92 + self.pset[k]

    def machine_from_top(self):
        """Machine from the level-absolute values of the top level."""
        matrix = np.eye(4)
        for k in range(len(self.frames) - 1, 0, -1):
            matrix = shift(self.offset(k - 1)) @ self.frames[k] @ matrix
        return matrix

    def shown(self):
        matrix = shift(self.offset(-1)) @ self.contour()
        return (np.linalg.inv(matrix) @ [*self.a, 1.0])[:3]

    def move(self, words, absolute):
        program = self.shown()
        for axis, value in words.items():
            program[axis] = value if absolute else program[axis] + value
        self.a = (shift(self.offset(-1)) @ self.contour() @ [*program, 1.0])[:3]
        return self.machine()

    def machine(self):
        return (self.machine_from_top() @ [*self.a, 1.0])[:3]

    def relevel(self, change):
        machine = self.machine()
        change()
        self.a = (np.linalg.inv(self.machine_from_top()) @ [*machine, 1.0])[:3]

    def push(self, kind, frame):
        rank = ORDER.index(kind)
        at = 1 + sum(ORDER.index(k) <= rank for k in self.kinds[1:])
        rows = ((self.frames, frame), (self.kinds, kind), (self.g92, np.zeros(3)))
        for stack, item in (*rows, (self.pset, np.zeros(3))):
            stack.insert(at, item)

    def pop(self, kind):
        at = max(k for k, other in enumerate(self.kinds) if other == kind)
        for stack in (self.frames, self.kinds, self.g92, self.pset):
            stack.pop(at)

    def select(self, count):
        while self.selected > count:
            self.selected -= 1
            self.pop("named")
        while self.selected < count:
            self.push("named", self.named[self.selected])
            self.selected += 1

    def set_named(self, k, frame):
        self.named[k] = frame
        if k < self.selected:
            self.frames[len(self.frames) - self.selected + k] = frame

    def track(self, k, target):
        """The frame that makes the machine position read `target` in named system k."""
        at = len(self.frames) - self.selected + k
        frames = [*self.frames, *self.named[self.selected :]]
        offsets = [self.offset(i) if i < len(self.frames) else np.zeros(3) for i in range(at + 1)]
        below = np.eye(4)
        for i in range(1, at + 1):
            below = below @ shift(offsets[i - 1]) @ (frames[i] if i < at else np.eye(4))
        if at == len(self.frames) - 1:
            target = (self.contour() @ [*target, 1.0])[:3]
        frame = frames[at].copy()
        tip = np.linalg.inv(below) @ [*self.machine(), 1.0]
        frame[:3, 3] = tip[:3] - frame[:3, :3] @ (offsets[at] + target)
        return frame

    def preset(self, axis, value):
        self.pset[-1] = self.pset[-1].copy()
        self.pset[-1][axis] += self.scale[axis] * (self.shown()[axis] - value)


def random_program(seed, blocks=60):
    """Lines of a program and the machine position after each motion, from the model."""
    rng = np.random.default_rng(seed)
    model, lines, expected = Model(), [], []
    plane = 17

    def number(low=-50, high=50):
        return round(float(rng.uniform(low, high)), 3)

    def motion():
        axes = rng.permutation(3)[: rng.integers(1, 4)]
        words = {int(axis): number() for axis in axes}
        absolute = bool(rng.integers(2))
        text = " ".join(f"{'XYZ'[a]}{v:.3f}" for a, v in words.items())
        lines.append(f"G{90 if absolute else 91} {text}")
        expected.append(model.move(words, absolute))

    def rotation():
        model.angle, model.centre = number(), (number(), number())
        model.plane = {17: 2, 18: 1, 19: 0}[plane]
        c1, c2 = model.centre
        lines.append(f"#ROTATION ON [ANGLE={model.angle} CENTER1={c1} CENTER2={c2}]")

    def rotation_off():
        model.angle = None
        lines.append("G69")

    def change_plane():
        nonlocal plane
        new = int(rng.integers(17, 20))
        if new != plane:
            model.angle = None
        plane = new
        lines.append(f"G{plane}")

    def mirror():
        if any(model.mirror_g92 < 0):
            return g351()
        g = int(rng.integers(20, 24))
        first, second = {17: (0, 1), 18: (2, 0), 19: (1, 2)}[plane]
        model.mirror = np.ones(3)
        if g in (21, 23):
            model.mirror[first] = -1
        if g in (22, 23):
            model.mirror[second] = -1
        lines.append(f"G{g}")
        return None

    def g351():
        if any(model.mirror < 0) and not any(model.mirror_g92 < 0):
            lines.append("G20")
        signs = rng.choice([-1.0, 1.0], 3)

        def change():
            model.mirror, model.mirror_g92 = signs, signs

        model.relevel(change)
        lines.append("G351 " + " ".join(f"{n}{int(s)}" for n, s in zip("XYZ", signs, strict=True)))

    def g92():
        axis, value, absolute = int(rng.integers(3)), number(), bool(rng.integers(2))
        model.g92[-1] = model.g92[-1].copy()
        model.g92[-1][axis] = value if absolute else model.g92[-1][axis] + value
        lines.append(f"G{90 if absolute else 91} G92 {'XYZ'[axis]}{value}")

    def scale():
        model.scale = np.array([abs(number()) + 0.1 for _ in range(3)]).round(3)
        x, y, z = model.scale
        lines.extend(["#SCALE OFF", f"#SCALE ON X{x} Y{y} Z{z}"])

    def preset():
        if model.angle is not None or any(model.mirror < 0):
            return
        axis, value = int(rng.integers(3)), number()
        model.preset(axis, value)
        lines.append(f"#PSET {'XYZ'[axis]}{value}")

    def values():
        v, f = [number() for _ in range(3)], [number(-180, 180) for _ in range(3)]
        frame = shift(v) @ turn(2, f[2]) @ turn(1, f[1]) @ turn(0, f[0])
        return "[" + ",".join(map(str, [*v, *f])) + "]", frame

    def system():
        kind = str(rng.choice(["CS", "CS", "ACS", "BCS"]))
        if model.kinds.count(kind) > 1:
            model.relevel(lambda: model.pop(kind))
            lines.append(f"#{kind} OFF")
            return
        text, frame = values()
        model.relevel(lambda: model.push(kind, frame))
        lines.append(f"#{kind} ON {text}")

    def add():
        if len(model.named) < 4:
            text, frame = values()
            lines.append(f"#CS ADD [S{len(model.named)}] {text}")
            model.named.append(frame)

    def select():
        if model.named:
            k = int(rng.integers(len(model.named)))
            model.relevel(lambda: model.select(k + 1))
            lines.append(f"#CS SELECT [S{k}]")

    def change():
        if not model.named:
            return
        k = int(rng.integers(len(model.named)))
        if rng.integers(2):
            text, frame = values()
            lines.append(f"#CS SET [S{k}] {text}")
        else:
            target = [number() for _ in range(3)]
            frame = model.track(k, target)
            lines.append(f"#CS TRACK [S{k}] [{','.join(map(str, target))}]")
        model.relevel(lambda: model.set_named(k, frame))

    def delete():
        if model.named and not rng.integers(4):
            below = min(model.selected, len(model.named) - 1)
            model.relevel(lambda: model.select(below))
            model.named.pop()
            lines.append("#CS DEL")

    choices = [rotation, rotation_off, change_plane, mirror, g351, g92, scale, preset]
    choices += [system, add, select, change, delete]
    for _ in range(blocks):
        motion()
        choices[rng.integers(len(choices))]()
    motion()
    return "\n".join([*lines, "M30"]), np.array(expected)


@pytest.mark.parametrize("seed", range(40))
def test_machine_positions(seed):
    text, expected = random_program(seed)
    result = ncscope.run(ncscope.Machine(), text).check()
    assert result.acs == pytest.approx(expected, abs=1e-8)


@pytest.mark.parametrize("seed", range(10))
def test_there_and_back_and_the_layers_sum_up(seed):
    text, _ = random_program(seed + 1000)
    result = ncscope.run(ncscope.Machine(), text).check()
    for stretch in result.stretches:
        assert stretch.coordinates.to_program(stretch.acs) == pytest.approx(stretch.pcs, abs=1e-8)
        back = stretch.coordinates.program_from_level(
            stretch.coordinates.level_from_program(stretch.pcs)
        )
        assert back == pytest.approx(stretch.pcs, abs=1e-8)
    for line in sorted({int(v) for v in result.line})[::5]:
        layers = result.explain(line).layers
        total = layers[0].values + np.sum([layer.change for layer in layers], axis=0)
        assert total == pytest.approx(layers[-1].values, abs=1e-9)
