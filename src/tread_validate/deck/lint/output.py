"""Findings as text, JSON, SARIF for code hosts, and annotations of GitHub's workflows."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any
from urllib.parse import quote

from ... import __version__
from .findings import Finding, catalogue

FORMATS = ("text", "json", "sarif", "github")
SARIF_LEVELS = {"error": "error", "warning": "warning", "note": "note"}
GITHUB_COMMANDS = {"error": "error", "warning": "warning", "note": "notice"}


def formatted(findings: Sequence[Finding], form: str) -> str:
    """Return findings in one of `FORMATS`, without a line end at the end."""
    if form == "json":
        return json.dumps([_entry(one) for one in findings], indent=1)
    if form == "sarif":
        return json.dumps(_sarif(findings), indent=1)
    if form == "github":
        return "\n".join(_annotation(one) for one in findings)
    return "\n".join(str(one) for one in findings)


def _entry(finding: Finding) -> dict[str, Any]:
    return {
        "file": finding.file, "line": finding.line, "code": finding.code, "rule": finding.rule,
        "severity": finding.severity, "message": finding.message,
    }  # fmt: skip


def _sarif(findings: Sequence[Finding]) -> dict[str, Any]:
    """Return a SARIF 2.1.0 log (OASIS Standard, 2020)."""
    used = sorted({one.rule for one in findings}, key=lambda name: catalogue()[name].code)
    rules = [
        {
            "id": catalogue()[name].code,
            "name": name,
            "shortDescription": {"text": catalogue()[name].title},
            "fullDescription": {"text": catalogue()[name].help},
            "defaultConfiguration": {"level": SARIF_LEVELS[catalogue()[name].severity]},
        }
        for name in used
    ]
    results = [
        {
            "ruleId": one.code,
            "ruleIndex": used.index(one.rule),
            "level": SARIF_LEVELS[one.severity],
            "message": {"text": one.message},
            "locations": [
                {"physicalLocation": {"artifactLocation": {"uri": _uri(one.file)}, "region": {"startLine": one.line}}}
            ],
        }
        for one in findings
    ]
    driver = {"name": "tread-validate lint", "version": __version__, "rules": rules}
    return {
        "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
        "version": "2.1.0",
        "runs": [{"tool": {"driver": driver}, "results": results}],
    }


def _uri(file: str) -> str:
    """Return a file name as a URI reference (RFC 3986), as SARIF asks for one."""
    return quote(file.replace("\\", "/"), safe="/")


def _annotation(finding: Finding) -> str:
    """Return a workflow command, with what would end it escaped."""
    text = finding.message.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")
    file = finding.file.replace("%", "%25").replace(",", "%2C").replace(":", "%3A")
    command = GITHUB_COMMANDS[finding.severity]
    return f"::{command} file={file},line={finding.line},title={finding.code} {finding.rule}::{text}"
