# Takes the contact and reaction forces of one job out of its .odb and writes them as CSV.
#
#   abaqus python extract_odb.py JOB.odb -o JOB_forces.csv [--step pass]
#
# Runs under the Python of ABAQUS: 2.7 (releases to 2023) and 3.x (from 2024). It needs nothing but odbAccess. Keep it
# free of anything that only one of the two grammars knows (no f-strings, no print statement, no annotations).
from __future__ import division

import hashlib
import io
import os
import re
import sys

VERSION = "1"
CONTACT = ("CFN1", "CFN2", "CFN3", "CFS1", "CFS2", "CFS3")
REACTION = ("RF1", "RF2", "RF3")
SLIPPING_ABOVE = 1.0  # mm/s, the least slip speed of the friction law
SAME_TIME = 1.0e-9  # s


class ExtractionError(Exception):
    """The .odb does not hold what is asked of it."""


def leading_name(key):
    """Return the variable's name: keys look like 'CFN2     ASSEMBLY_SLAVE/ASSEMBLY_MASTER', padded at will."""
    return key.replace(":", " ").split()[0].upper() if key.split() else ""


def set_name(region_key, region):
    """Return the node set that a history region belongs to, or the region's own name where it says none."""
    text = "%s %s" % (region_key, getattr(region, "description", "") or "")
    found = re.search(r"(?:NSET|node set)\s+([\w.\-]+)", text, re.IGNORECASE)
    name = found.group(1) if found else region_key
    return re.sub(r"[^A-Za-z0-9_.\-]+", "_", name).strip("_").upper()


def add(columns, times, name, data):
    """Add one history to the column of its name; histories of one column must share their times."""
    own = [float(pair[0]) for pair in data]
    values = [float(pair[1]) for pair in data]
    if not own:
        return
    if not times:
        times.extend(own)
    if len(own) != len(times) or max(abs(a - b) for a, b in zip(own, times)) > SAME_TIME:
        raise ExtractionError("%s: its times differ from those of the columns before it" % name)
    if name in columns:
        columns[name] = [a + b for a, b in zip(columns[name], values)]
    else:
        columns[name] = values


def forces(step):
    """Return the times and columns of a step: total contact forces, and reactions summed over each node set."""
    times, columns, pairs = [], {}, {}
    for region_key in step.historyRegions.keys():
        region = step.historyRegions[region_key]
        for key in region.historyOutputs.keys():
            name = leading_name(key)
            if name in CONTACT:
                pair = " ".join(key.split()[1:])
                if pairs.setdefault(name, pair) != pair:
                    raise ExtractionError("%s: more than one contact pair: %s; %s" % (name, pairs[name], pair))
                add(columns, times, name, region.historyOutputs[key].data)
            elif name in REACTION:
                column = "%s@%s" % (name, set_name(region_key, region))
                add(columns, times, column, region.historyOutputs[key].data)
    missing = [name for name in ("CFN1", "CFN2", "CFS1", "CFS2") if name not in columns]
    if missing:
        raise ExtractionError("no history output %s in step %s" % (", ".join(missing), step.name))
    return times, columns


def field(frame, name):
    """Return {node: value} of a scalar contact field, empty where the frame has none."""
    found = {}
    for key in frame.fieldOutputs.keys():
        if leading_name(key) == name:
            for value in frame.fieldOutputs[key].values:
                data = value.data
                found[value.nodeLabel] = float(data if not hasattr(data, "__len__") else data[0])
    return found


def slipping(step, times):
    """Return the share of touching nodes that slip, linear between the field frames, or None without such fields."""
    at, share = [], []
    for frame in step.frames:
        pressure = field(frame, "CPRESS")
        if not pressure:
            continue
        first, second = field(frame, "FSLIPR1"), field(frame, "FSLIPR2")
        if not first:
            first = field(frame, "FSLIPR")
        if not first:
            return None
        touching = [node for node in pressure if pressure[node] > 0.0]
        moving = [
            node
            for node in touching
            if (first.get(node, 0.0) ** 2 + second.get(node, 0.0) ** 2) ** 0.5 > SLIPPING_ABOVE
        ]
        at.append(float(frame.frameValue))
        share.append(len(moving) / float(len(touching)) if touching else 0.0)
    return [between(at, share, time) for time in times] if at else None


def between(at, values, time):
    """Return linear interpolation, constant beyond the ends."""
    if time <= at[0]:
        return values[0]
    for index in range(1, len(at)):
        if time <= at[index]:
            part = (time - at[index - 1]) / (at[index] - at[index - 1])
            return values[index - 1] + part * (values[index] - values[index - 1])
    return values[-1]


def sha256(path):
    """Return the SHA-256 of a file in hex, or an empty string where it is not there."""
    if not os.path.isfile(path):
        return ""
    digest = hashlib.sha256()
    stream = io.open(path, "rb")
    try:
        digest.update(stream.read())
    finally:
        stream.close()
    return digest.hexdigest()


def routine_of(folder, job):
    """Return the path of the friction routine of a job: decks with general contact have one of their own."""
    name = "vfriction" if job.endswith("-general-contact") else "vfric"
    windows = os.path.join(folder, name + ".for")
    return windows if os.path.isfile(windows) else os.path.join(folder, name + ".f")


def csv_text(notes, times, columns):
    """Return the table with its notes."""
    names = [name for name in CONTACT if name in columns]
    names += sorted(name for name in columns if name not in CONTACT)
    lines = ["# %s: %s" % (key, value) for key, value in notes]
    lines.append(",".join(["time_s"] + [name if name == "slipping_fraction" else name + "_N" for name in names]))
    for row, time in enumerate(times):
        lines.append(",".join("%.9g" % value for value in [time] + [columns[name][row] for name in names]))
    return "\n".join(lines) + "\n"


def extract(odb_path, output, step_name):
    """Write the forces of one step of one .odb."""
    from odbAccess import openOdb

    odb = openOdb(path=odb_path, readOnly=True)
    try:
        if step_name not in odb.steps.keys():
            # deck names are kept in upper case by some releases
            names = [name for name in odb.steps.keys() if name.upper() == step_name.upper()]
            if not names:
                raise ExtractionError("no step %s; there are %s" % (step_name, ", ".join(odb.steps.keys())))
            step_name = names[0]
        step = odb.steps[step_name]
        times, columns = forces(step)
        share = slipping(step, times)
        if share is not None:
            columns["slipping_fraction"] = share
        job = os.path.splitext(os.path.basename(odb_path))[0]
        folder = os.path.dirname(os.path.abspath(odb_path))
        data = getattr(odb, "jobData", None)
        notes = [
            ("producer", "extract_odb.py %s, Python %d.%d" % ((VERSION,) + tuple(sys.version_info[:2]))),
            ("job", job),
            ("abaqus_version", getattr(data, "version", "")),
            ("analysis", getattr(data, "analysisCode", "")),
            ("precision", getattr(data, "precision", "")),
            ("step", step_name),
            ("step_duration_s", "%.9g" % float(getattr(step, "timePeriod", times[-1]))),
            ("clock", "step"),
            ("deck_sha256", sha256(os.path.join(folder, job + ".inp"))),
            ("user_sha256", sha256(routine_of(folder, job))),
        ]
    finally:
        odb.close()
    temporary = output + ".part"
    stream = io.open(temporary, "wb")
    try:
        stream.write(csv_text(notes, times, columns).encode("utf-8"))
    finally:
        stream.close()
    if os.path.exists(output):
        os.remove(output)
    os.rename(temporary, output)


def main(arguments):
    """Read the arguments, extract, and return the exit code."""
    words = [word for word in arguments if word != "--"]
    options = {"-o": "", "--step": "pass"}
    files = []
    while words:
        word = words.pop(0)
        if word in options:
            if not words:
                sys.stderr.write("extract_odb: %s needs a value\n" % word)
                return 2
            options[word] = words.pop(0)
        else:
            files.append(word)
    if len(files) != 1 or not options["-o"]:
        sys.stderr.write("usage: abaqus python extract_odb.py JOB.odb -o FORCES.csv [--step pass]\n")
        return 2
    try:
        extract(files[0], options["-o"], options["--step"])
    except ExtractionError as error:
        sys.stderr.write("extract_odb: %s: %s\n" % (files[0], error))
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
