#!/usr/bin/python3
"""Another law takes over in the air, and is guarded as the first one was."""
import os
import sys

import rospkg
import rospy
import yaml

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import PACKAGE, GuardedTest, run  # noqa: E402


class LawChange(GuardedTest):
    def test_law_change(self):
        self.uav.take_off()
        path = os.path.join(rospkg.RosPack().get_path(PACKAGE), 'config', 'controller', 'smc.yaml')
        with open(path) as file:
            rospy.delete_param('/uav/controller/gains')
            rospy.set_param('/uav/controller/gains', yaml.safe_load(file))
        self.uav.obey('reload_parameters')
        self.uav.wait('smc', lambda: self.uav.state.controller == 'smc')
        self.expect_holding()
        self.uav.spoil = lambda message: None
        self.uav.wait_mode('emergency descent')
        self.expect_landed()

if __name__ == '__main__':
    run(LawChange)
