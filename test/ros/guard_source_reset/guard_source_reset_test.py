#!/usr/bin/python3
"""An estimator that starts anew somewhere else moves the set point, not the vehicle."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class SourceReset(GuardedTest):
    def test_source_reset(self):
        self.uav.take_off()

        def moved(message):
            message.pose.pose.position.x += 2.0
            return message
        self.uav.spoil = moved
        self.uav.wait('the reset', lambda: self.uav.state.mode_reason == 'source reset')
        self.expect_holding()
        self.assertLess(abs(self.uav.truth.x), 0.3)
        self.assertAlmostEqual(self.uav.state.position.x, 2.0, delta=0.3)

if __name__ == '__main__':
    run(SourceReset)
