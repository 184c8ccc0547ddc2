"""voxmelt melts solid voxel models and lets them flow, by an exact 3D cellular automaton.

    import voxmelt

    cello = voxmelt.Simulation("scenes/cello.toml")
    for state in cello.run(600, every=100):
        print(cello.steps_done(), state.liquid.sum())
    cello.draw("cello.png")

It is the library of C++ by the same names. Fields are arrays of NumPy, indexed [z, y, x].
"""
from __future__ import annotations

from typing import Iterator, Optional

from . import _voxmelt
from ._voxmelt import *  # noqa: F403
from ._voxmelt import State, version

__version__ = version()


class Simulation(_voxmelt._Simulation):
    __doc__ = _voxmelt._Simulation.__doc__

    def run(self, steps: Optional[int] = None, *, every: int = 1) -> Iterator[State]:
        """Runs steps, and gives the state after each `every` of them and after the last.

        A state is good until the next one is asked for; copies of its fields stay.
        steps: as many as the scene suggests, less those that are done, if it is not given
        Raises InputError for numbers out of their range.
        """
        left = max(0, self.scene_steps() - self.steps_done()) if steps is None else steps
        if every < 1 or left < 0:
            raise _voxmelt.InputError(f"run: error: steps = {left}, every = {every}: want 0 or more, and 1 or more")
        return self._states(left, every)

    def _states(self, left: int, every: int) -> Iterator[State]:
        while left > 0:
            left -= self.step(min(every, left))
            yield self.state()
