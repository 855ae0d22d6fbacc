"""Holds scenarios or plans against their JSON Schema with another implementation of it.

    brinell schema > schema.json
    python3 .ci/check_schema.py schema.json examples/*.toml
    brinell schema --plan > schema.json
    python3 .ci/check_schema.py schema.json examples/plans/*.toml
"""

import copy
import json
import sys
import tomllib
from pathlib import Path

from jsonschema import Draft202012Validator

# A schema that refuses nothing would accept these, too: table, key, value.
WRONG = {
    "brinell scenario": [
        ("bearing", "no_such_key", 1.0),
        ("operation", "speed_rpm", "fast"),
    ],
    "brinell machine": [
        ("shaft", "no_such_key", 1.0),
        ("shaft", "stations_mm", "long"),
        ("operation", "load_n", [0.0, 1.0]),
    ],
    "brinell plan": [
        ("", "no_such_key", 1.0),
        ("", "runs", 0),
        ("", "design", "halton"),
        ("vary", "operation", {"no_such_key": 1.0}),
        ("vary", "operation", {"speed_rpm": "fast"}),
        ("vary", "operation", {"speed_rpm": {"unifrom": [900, 3000]}}),
        ("vary", "operation", {"speed_rpm": {"uniform": [900, 3000, 9000]}}),
        ("vary", "operation", {"speed_rpm": {"log": [0, 3000]}}),
        ("vary", "operation", {"speed_rpm": {"choice": [900], "within": [1, 2]}}),
        ("", "machines", 0),
        ("", "machines", 3),
        ("history", "law", "linear"),
        ("history", "begins_at", 1.5),
        ("history", "life_h", {"uniform": [900]}),
        ("history", "snapshot", {"operation": {"no_such_key": 1.0}}),
        ("", "classes", [{"share": 1.0}]),
        ("", "classes", [{"name": "outer", "defects": [{"depth_um": {"log": [2, 50]}}]}]),
    ],
}

schema = json.loads(Path(sys.argv[1]).read_text())
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)

for path in sys.argv[2:]:
    document = tomllib.loads(Path(path).read_text())
    for error in validator.iter_errors(document):
        sys.exit(f"{path}: {error.json_path}: {error.message}")
    for table, key, value in WRONG[schema["title"]]:
        wrong = copy.deepcopy(document)
        (wrong.setdefault(table, {}) if table else wrong)[key] = value
        # What one plan may not have another has: histories have machines.
        if wrong != document and validator.is_valid(wrong):
            sys.exit(f"{path}: the schema accepts {table}.{key} = {value!r}")
    print(f"{path}: fits the schema")
