# Says for each line of a file of JSON documents whether it is valid under a JSON Schema: an independent judge of ours.
import json
import sys

from jsonschema import Draft202012Validator

with open(sys.argv[1], encoding="utf-8") as file:
    schema = json.load(file)
Draft202012Validator.check_schema(schema)
validator = Draft202012Validator(schema)
with open(sys.argv[2], encoding="utf-8") as file:
    for line in file:
        print("valid" if validator.is_valid(json.loads(line)) else "invalid")
