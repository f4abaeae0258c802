"""The interface's description is complete, and its examples are true."""

import json
import subprocess
import sys

import pytest
from pydantic import TypeAdapter

from db import patient
from server.api import errors, forms
from server.api.app import describe_app
from server.api.openapi import openapi_document

DOCUMENT = openapi_document(describe_app())
OPERATIONS = {
    f"{method.upper()} {path}": operation
    for path, methods in DOCUMENT["paths"].items()
    for method, operation in methods.items()
}
FORMS = {
    name: form
    for module in (forms, errors, patient)
    for name, form in vars(module).items()
    if isinstance(form, type) and getattr(form, "model_config", {}).get("json_schema_extra")
}


@pytest.mark.parametrize("name", FORMS)
def test_every_example_is_a_valid_form(name):
    for example in FORMS[name].model_config["json_schema_extra"]["examples"]:
        TypeAdapter(FORMS[name]).validate_json(json.dumps(example))


@pytest.mark.parametrize("operation", OPERATIONS)
def test_every_operation_says_what_it_does_and_how_it_fails(operation):
    described = OPERATIONS[operation]
    assert described["description"]
    failures = {status: answer for status, answer in described["responses"].items() if status >= "400"}
    assert failures
    for answer in failures.values():
        assert answer["content"]["application/json"]["schema"]["$ref"].endswith("/ErrorResponse")


@pytest.mark.parametrize("operation", OPERATIONS)
def test_every_operation_that_takes_a_form_gives_an_example_of_it(operation):
    body = OPERATIONS[operation].get("requestBody")
    if body is None:
        return
    name = body["content"]["application/json"]["schema"]["$ref"].rsplit("/", 1)[1]
    assert DOCUMENT["components"]["schemas"][name].get("examples"), name


def test_every_reference_leads_somewhere():
    text = json.dumps(DOCUMENT)
    named = {part.split('"')[0] for part in text.split("#/components/schemas/")[1:]}
    assert named <= set(DOCUMENT["components"]["schemas"])


def test_the_stream_is_described_too():
    assert {"LiveMessage", "LiveTick", "GameView", "SessionView", "Acknowledgement"} <= set(
        DOCUMENT["components"]["schemas"]
    )


def test_the_command_writes_the_same_document(tmp_path):
    file = tmp_path / "openapi.json"
    subprocess.run([sys.executable, "-m", "server.api.openapi", str(file)], check=True)
    assert json.loads(file.read_text("utf-8")) == json.loads(json.dumps(DOCUMENT))
