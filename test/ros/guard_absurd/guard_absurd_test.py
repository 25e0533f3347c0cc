#!/usr/bin/python3
"""Numbers that no vehicle can have are refused and leave no trace (BUG 2)."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Absurd(GuardedTest):
    def test_absurd(self):
        self.uav.take_off()
        mass = self.uav.state.mass_estimate
        for number in (float('nan'), float('inf'), 1e308, 1e200, 1e30, 1e6):
            numbers = [number]

            def once(message):
                if numbers:
                    message.pose.pose.position.z = numbers.pop()
                return message
            self.uav.spoil = once
            self.uav.sleep(0.5)
        self.assertGreaterEqual(self.uav.state.dropped_odometry, 6)
        self.assertEqual(self.uav.state.mode, 'holding')
        self.assertAlmostEqual(self.uav.state.mass_estimate, mass, delta=0.1)
        self.assertLess(self.uav.error(), 0.2)


if __name__ == '__main__':
    run(Absurd)
