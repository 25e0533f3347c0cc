#!/usr/bin/python3
"""A payload that leaves no thrust to steer with is landed."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Overload(GuardedTest):
    def test_overload(self):
        self.uav.take_off()
        self.uav.attach(1.95)
        self.uav.wait_mode('landing')
        self.assertEqual(self.uav.state.mode_reason, 'overload')
        self.expect_landed()

if __name__ == '__main__':
    run(Overload)
