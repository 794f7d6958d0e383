"""Checks against the official schema of CycloneDX and SPDX's licence expressions.

Source   cyclonedx/SOURCE; python3-jsonschema and python3-license-expression read what we write.
"""

import json
import pathlib

import jsonschema
from license_expression import Licensing

FOLDER = pathlib.Path(__file__).parent / "cyclonedx"
SCHEMAS = {name: json.loads((FOLDER / f"{name}.schema.json").read_text(encoding="utf-8")) for name in ("bom-1.4", "spdx", "jsf-0.82")}


def schema_errors(bill):
    """The reasons why a bill of materials violates the schema; empty: it follows the schema."""
    resolver = jsonschema.RefResolver.from_schema(SCHEMAS["bom-1.4"], store={schema["$id"]: schema for schema in SCHEMAS.values()})
    return [error.message for error in jsonschema.Draft7Validator(SCHEMAS["bom-1.4"], resolver=resolver).iter_errors(bill)]


def unknown_of(expression):
    """The names in an expression that are neither on SPDX's lists of licences and exceptions nor our own references."""
    names = Licensing().license_keys(Licensing().parse(expression.replace(" WITH ", " AND ")))
    return [name for name in names if name not in SCHEMAS["spdx"]["enum"] and not name.startswith("LicenseRef-Debian-")]
