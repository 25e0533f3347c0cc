#!/usr/bin/python3
"""Every order of the guard, obeyed where it makes sense and refused elsewhere."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Orders(GuardedTest):
    def test_orders(self):
        self.uav.wait_until_ready()
        self.uav.wait('odometry', lambda: self.uav.state.odometry_silence < 0.1)
        self.assertEqual(self.uav.state.mode, 'disarmed')
        for order in ('take_off', 'land', 'hold'):
            self.assertFalse(self.uav.order(order).success)
        self.uav.go(0.0, 0.0, 1.5)
        self.uav.sleep(1.0)
        self.assertEqual(self.uav.state.mode, 'disarmed', 'nobody asked')
        self.uav.take_off()
        self.assertFalse(self.uav.order('disarm').success)
        self.assertFalse(self.uav.order('arm').success)
        self.assertTrue(self.uav.go_to(1.0, 0.0, 1.2).success)
        self.assertFalse(self.uav.go_to(float('nan'), 0.0, 1.2).success)
        self.uav.sleep(6.0)
        self.assertAlmostEqual(self.uav.state.position.x, 1.0, delta=0.1)
        self.uav.obey('land')
        self.expect_landed()


if __name__ == '__main__':
    run(Orders)
