#!/usr/bin/env bash
# Blender's Cycles renders a rolling shutter, and a lamp's strength can be animated, also many times within a
# frame. One would expect the stripes of a blinking lamp, as any rolling-shutter camera shows them. The
# shutter applies to what moves only: lamps and materials have one value a frame. An edge that moves within the frame
# comes out slanted, line by line, while the lamp behind it, which switches 32 times in the same frame,
# lights all lines alike. Pictures of blinking lamps have to be put together from many frames.
# (bpy 5.0 needs Python 3.11 and is a package of about 370 MB.)
set -euo pipefail

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/pip" install --quiet bpy==5.0.1
cd "$folder"
"$folder/venv/bin/python" - <<'PYTHON'
import sys
import warnings

warnings.simplefilter("ignore")
import bpy
import numpy as np
from bpy_extras import anim_utils

print("Python", sys.version.split()[0], "Blender", bpy.app.version_string)
LINES, COLUMNS, SWITCHES = 64, 32, 32
bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.engine = "CYCLES"
scene.cycles.device = "CPU"
scene.cycles.samples = 32
scene.cycles.use_denoising = False
scene.render.resolution_x, scene.render.resolution_y = COLUMNS, LINES
scene.render.use_motion_blur = True
scene.render.motion_blur_shutter = 1.0
scene.cycles.rolling_shutter_type = "TOP"
scene.cycles.rolling_shutter_duration = 0.02
scene.view_settings.view_transform = "Raw"
scene.render.image_settings.file_format = "OPEN_EXR"


def material(strength):
    made = bpy.data.materials.new("material")
    made.use_nodes = True
    nodes = made.node_tree.nodes
    nodes.clear()
    light, output = nodes.new("ShaderNodeEmission"), nodes.new("ShaderNodeOutputMaterial")
    made.node_tree.links.new(light.outputs[0], output.inputs[0])
    light.inputs["Strength"].default_value = strength
    return made, light.inputs["Strength"]


def keyframes_of(animated):
    data = animated.animation_data
    curves = anim_utils.action_get_channelbag_for_slot(data.action, data.action_slot).fcurves
    return [point for curve in curves for point in curve.keyframe_points]


lamp_material, strength = material(0.0)
bpy.ops.mesh.primitive_plane_add(size=20)
bpy.context.object.data.materials.append(lamp_material)
for k in range(-SWITCHES, 2 * SWITCHES):
    strength.default_value = (k + 1) % 2
    strength.keyframe_insert("default_value", frame=1 + (k - 0.5) / SWITCHES)
for point in keyframes_of(lamp_material.node_tree):
    point.interpolation = "CONSTANT"

bpy.ops.mesh.primitive_plane_add(size=1, location=(0, 0, 1))
shade = bpy.context.object
shade.scale = (2, 20, 1)
shade.data.materials.append(material(0.0)[0])
for frame, x in ((0, -2.0), (2, 0.0)):
    shade.location.x = x
    shade.keyframe_insert("location", frame=frame)
for point in keyframes_of(shade):
    point.interpolation = "LINEAR"

camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
camera.data.type, camera.data.ortho_scale = "ORTHO", 4.0
camera.location.z = 5
scene.collection.objects.link(camera)
scene.camera = camera
scene.frame_set(1)
scene.render.filepath = "//picture.exr"
bpy.ops.wm.save_as_mainfile(filepath="scene.blend")
bpy.ops.render.render(write_still=True)
picture = bpy.data.images.load("//picture.exr")
light = np.array(picture.pixels[:]).reshape(LINES, COLUMNS, 4)[::-1, :, 0]

lines_of_lamp = light[:, -4:].mean(axis=1)
edge = (light < 0.5).sum(axis=1)
print("lamp beside the shade, lines 0, 8, 16 ...:", lines_of_lamp[::8].round(3))
print("columns that the moving shade covers, lines 0, 8, 16 ...:", edge[::8])
assert np.ptp(lines_of_lamp) < 0.02 and lines_of_lamp.mean() > 0.9
assert edge[-1] - edge[0] >= 6
PYTHON
