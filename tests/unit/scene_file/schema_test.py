"""Every shipped scene fits the schema, and every scene in a folder `refused` does not.

usage: schema_test.py SCHEMA FOLDER...
"""
import json
import pathlib
import sys

import jsonschema


def refuse_constant(name):
    raise ValueError(f"{name} is no JSON number")


def fault_of(path, validator):
    """What is wrong with a file, or None."""
    try:
        document = json.loads(path.read_text(), parse_constant=refuse_constant)
    except ValueError as fault:
        return str(fault)
    errors = sorted(validator.iter_errors(document), key=lambda e: [str(key) for key in e.path])
    return f"{list(errors[0].path)}: {errors[0].message[:120]}" if errors else None


def is_scene(path):
    return path.name != "scene.schema.json" and '"surfaces"' in path.read_text() and '"vertices"' in path.read_text()


def main(schema, *folders):
    schema = json.loads(pathlib.Path(schema).read_text())
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    scenes = sorted(p for folder in folders for p in pathlib.Path(folder).rglob("*.json") if is_scene(p))
    wrong = 0
    for path in scenes:
        fault = fault_of(path, validator)
        if (fault is not None) != ("refused" in path.parts):
            wrong += 1
            print(f"{path}: {fault or 'fits the schema, but should be refused'}")
    print(f"{len(scenes)} scenes, {wrong} wrong")
    return 1 if wrong or len(scenes) < 4 else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
