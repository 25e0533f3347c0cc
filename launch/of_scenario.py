"""Prints what a scenario file asks for; launch files cannot look into YAML.

usage: python3 of_scenario.py CONFIG_FOLDER SCENARIO vehicle|control_rate
vehicle prints the whole vehicle file that the scenario names, control_rate its number.
"""
import os
import sys

import yaml

config, scenario, key = sys.argv[1:]
with open(os.path.join(config, 'scenario', scenario + '.yaml')) as text:
    value = yaml.safe_load(text)[key]
if key == 'vehicle':
    with open(os.path.join(config, 'vehicle', value + '.yaml')) as text:
        value = text.read()
print(value)
