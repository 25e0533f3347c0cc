#!/usr/bin/python3
"""kill -9 of the simulator, and with it of the clock: the commands cease."""
import os
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, kill_node, run  # noqa: E402
from uav import ERROR, Diagnostics  # noqa: E402


class PlantDies(GuardedTest):
    def test_plant_dies(self):
        self.uav.take_off()
        diagnostics = Diagnostics(self.uav)
        kill_node('/uav/plant')
        time.sleep(0.5)
        count = len(self.uav.motors)
        time.sleep(2.0)
        self.assertLessEqual(len(self.uav.motors), count + 1)
        diagnostics.expect('odometry', (ERROR,))

if __name__ == '__main__':
    run(PlantDies)
