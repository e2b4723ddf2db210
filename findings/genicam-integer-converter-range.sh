#!/usr/bin/env bash
# A camera of industry describes its features in GenICam's XML. An exposure time may be a number of clock ticks
# in the camera, and a converter with one formula each way gives it in microseconds: a Converter for floats,
# an IntConverter for integers. Both have an optional element Slope, "Automatic" unless given otherwise, by
# which their range is found. One would expect the same range from both, 10 to 1000000 us for 1 to 100000
# ticks of 10 us. In the reference software, in the package genicam, the IntConverter without that element
# has the range from 0 to 0, which its own value exceeds, and no exposure can be set. The Converter works without it.
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet genicam==1.6.0
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
from importlib.metadata import version

from genicam import genapi

print("Python", sys.version.split()[0], "genicam", version("genicam"))
GENICAM, SCHEMA = "http:/" + "/www.genicam.org/GenApi/Version_1_1", "http:/" + "/www.w3.org/2001/XMLSchema-instance"
DESCRIPTION = f"""<?xml version="1.0" encoding="utf-8"?>
<RegisterDescription ModelName="Camera" VendorName="Maker" ToolTip="A camera" StandardNameSpace="None"
 SchemaMajorVersion="1" SchemaMinorVersion="1" SchemaSubMinorVersion="0" MajorVersion="1" MinorVersion="0"
 SubMinorVersion="0" ProductGuid="11111111-2222-3333-4444-555555555555"
 VersionGuid="11111111-2222-3333-4444-555555555556" xmlns="{GENICAM}" xmlns:xsi="{SCHEMA}"
 xsi:schemaLocation="{GENICAM} {GENICAM.replace('Version', 'GenApiSchema_Version')}.xsd">
<Category Name="Root"><pFeature>Exposure</pFeature></Category>
<Integer Name="Ticks"><Value>100</Value><Min>1</Min><Max>100000</Max></Integer>
<KIND Name="Exposure"><FormulaTo>FROM/10</FormulaTo><FormulaFrom>TO*10</FormulaFrom><pValue>Ticks</pValue>SLOPE</KIND>
</RegisterDescription>"""
ranges = {}
for kind in ("Converter", "IntConverter"):
    for slope in ("", "<Slope>Automatic</Slope>"):
        camera = genapi.NodeMap()
        camera.load_xml_from_string(DESCRIPTION.replace("KIND", kind).replace("SLOPE", slope))
        exposure = camera.get_node("Exposure")
        ranges[kind, bool(slope)] = (exposure.min, exposure.max)
        try:
            exposure.value = 2000
            outcome = f"{camera.get_node('Ticks').value} ticks"
        except genapi.OutOfRangeException:
            outcome = "OutOfRangeException"
        print(f"{kind}, {slope or 'no Slope'}: range {exposure.min} to {exposure.max} us, setting 2000 us: {outcome}")
        assert (outcome == "200 ticks") == (ranges[kind, bool(slope)] == (10, 1000000))
assert ranges.pop(("IntConverter", False)) == (0, 0) and set(ranges.values()) == {(10, 1000000)}
PYTHON
