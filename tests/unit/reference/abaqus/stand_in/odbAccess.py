"""Stands in for ABAQUS's module in the tests: an .odb is JSON with the shape of the documented object model."""

from __future__ import division, print_function  # noqa: UP010 - also runs under Python 2.7

import json


class Thing(object):  # noqa: UP004
    def __init__(self, **values):
        self.__dict__.update(values)


def _region(data):
    outputs = dict((key, Thing(data=rows)) for key, rows in data["outputs"].items())  # noqa: C402
    return Thing(description=data.get("description", ""), historyOutputs=outputs)


def _frame(data):
    fields = {}
    for key, values in data["fields"].items():
        fields[key] = Thing(values=[Thing(nodeLabel=int(node), data=value) for node, value in values.items()])
    return Thing(frameValue=data["time"], fieldOutputs=fields)


def openOdb(path, readOnly):
    stream = open(path)  # noqa: SIM115
    data = json.load(stream)
    stream.close()
    assert readOnly
    steps = {}
    for name, step in data["steps"].items():
        steps[name] = Thing(
            name=name,
            timePeriod=step["duration"],
            historyRegions=dict((key, _region(item)) for key, item in step["regions"].items()),  # noqa: C402
            frames=[_frame(frame) for frame in step.get("frames", [])],
        )
    job = Thing(version=data.get("version", "6.14-1"), analysisCode="ABAQUS/EXPLICIT", precision="DOUBLE_PRECISION")
    return Thing(steps=steps, jobData=job, close=lambda: None)
