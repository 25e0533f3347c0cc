#!/usr/bin/python3
"""Messages that come twice or in the wrong order are counted and do no harm."""
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(__file__), os.pardir))
from guarded import GuardedTest, run  # noqa: E402


class Order(GuardedTest):
    def test_order(self):
        self.uav.take_off()
        kept = []

        def swapped(message):
            """Every second message after the next one, and that one twice."""
            if not kept:
                kept.append(message)
                return None
            self.uav.relay.publish(message)
            self.uav.relay.publish(message)
            return kept.pop()
        self.uav.spoil = swapped
        self.assertTrue(self.uav.go_to(1.0, 0.0, 1.2).success)
        self.uav.sleep(4.0)
        self.expect_holding()
        self.assertGreater(self.uav.state.dropped_odometry, 100)

if __name__ == '__main__':
    run(Order)
