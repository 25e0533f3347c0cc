#!/usr/bin/python3
"""Kill stops the rotors at once and for ever."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Kill(GuardedTest):
    def test_kill(self):
        self.uav.take_off()
        self.uav.obey('kill')
        self.uav.wait('still rotors', lambda: max(
            self.uav.motors[-1].angular_velocities) == 0.0)
        self.uav.wait_mode('killed')  # the state is published after the rotors' command
        self.assertFalse(self.uav.order('arm').success)


if __name__ == '__main__':
    run(Kill)
