"""How long each stage of some work has taken, as whoever waits for it sees it."""

from __future__ import annotations

import time


class StageTimes:
    """Times by the clock. Until the first stage begins, the stage has the empty name."""

    def __init__(self) -> None:
        self.stage = ""
        self._since = time.monotonic()
        self._spent: dict[str, float] = {}

    def begin(self, stage: str) -> None:
        """A stage begins, and the one before ends."""
        now = time.monotonic()
        self._spent[self.stage] = self._spent.get(self.stage, 0.0) + now - self._since
        self.stage, self._since = stage, now

    def longest(self) -> tuple[str, float]:
        """The stage that has taken the longest so far, and its seconds."""
        self.begin(self.stage)
        return max(self._spent.items(), key=lambda item: item[1])
