#!/usr/bin/python3
"""Goals that change their mind faster than anything flies keep speed and tilt within limits."""
import os
import random
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Goals(GuardedTest):
    def test_goals(self):
        self.uav.take_off()
        dice = random.Random(7)
        first = len(self.uav.states)
        for _ in range(25):
            self.uav.go(dice.uniform(-9, 9), dice.uniform(-9, 9), dice.uniform(1, 9),
                        dice.uniform(-3, 3))
            self.uav.sleep(0.3)
        self.uav.obey('hold')
        for state in self.uav.states[first:]:
            q = state.attitude
            self.assertGreater(1 - 2 * (q.x ** 2 + q.y ** 2), 0.7, 'tilted by 45 deg')
            self.assertGreater(state.position.z, 0.7)
        self.expect_holding()


if __name__ == '__main__':
    run(Goals)
