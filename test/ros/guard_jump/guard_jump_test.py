#!/usr/bin/python3
"""A message from somewhere else is refused, and the next good one is heard."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Jump(GuardedTest):
    def test_jump(self):
        self.uav.take_off()
        jumps = [5.0, -0.8, 2.0]
        while jumps:
            jump = [jumps.pop()]

            def once(message):
                if jump:
                    message.pose.pose.position.y += jump.pop()
                return message
            self.uav.spoil = once
            self.uav.sleep(0.7)
            self.assertLess(abs(self.uav.truth.y), 0.1)
        self.assertGreaterEqual(self.uav.state.dropped_odometry, 3)
        self.expect_holding()

if __name__ == '__main__':
    run(Jump)
