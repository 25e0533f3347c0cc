#!/usr/bin/python3
"""What the rotors cannot lift sinks, is landed and told."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402
from uav import Diagnostics  # noqa: E402


class TooHeavy(GuardedTest):
    def test_too_heavy(self):
        self.uav.take_off()
        diagnostics = Diagnostics(self.uav)
        self.uav.attach(2.2)
        self.uav.wait('the rotors to stop', lambda: self.uav.state.mode == 'disarmed')
        self.expect_landed()
        for state in self.uav.states:
            self.assertLess(state.mass_estimate, 4.2, 'more than the rotors lift')
        self.assertIn('guard', diagnostics.found)

if __name__ == '__main__':
    run(TooHeavy)
