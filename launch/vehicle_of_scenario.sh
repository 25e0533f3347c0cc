# Prints the vehicle file that a scenario asks for; launch files cannot look into YAML.
# usage: bash vehicle_of_scenario.sh CONFIG_FOLDER SCENARIO
set -e
vehicle=$(sed -n 's/^vehicle: *\([A-Za-z0-9_]*\).*/\1/p' "$1/scenario/$2.yaml")
cat "$1/vehicle/$vehicle.yaml"
