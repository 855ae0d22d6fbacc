"""Holds scenarios against the scenario's JSON Schema with another implementation of it.

    brinell schema > schema.json
    python3 .ci/check_schema.py schema.json examples/*.toml
"""

import copy
import json
import sys
import tomllib
from pathlib import Path

from jsonschema import Draft202012Validator

schema = json.loads(Path(sys.argv[1]).read_text())
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)

for path in sys.argv[2:]:
    scenario = tomllib.loads(Path(path).read_text())
    for error in validator.iter_errors(scenario):
        sys.exit(f"{path}: {error.json_path}: {error.message}")
    # A schema that refuses nothing would pass the line above.
    for section, key, value in [("bearing", "no_such_key", 1.0), ("operation", "speed_rpm", "fast")]:
        wrong = copy.deepcopy(scenario)
        wrong[section][key] = value
        if validator.is_valid(wrong):
            sys.exit(f"{path}: the schema accepts {section}.{key} = {value!r}")
    print(f"{path}: fits the schema")
