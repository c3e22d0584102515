"""Karinui in Blender: a garment and its pattern are brought in, changed by operations and draped anew. The work is done
by the program karinui, a process of its own that this add-on speaks to over its pipes."""
import pathlib

import bpy
from bpy.app.translations import pgettext, pgettext_iface
from bpy.props import StringProperty
from bpy_extras.io_utils import ImportHelper

from . import garment
from .client import Karinui, Refused
from .words import WORDS

bl_info = {
    "name": "Karinui",
    "author": "The Karinui authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import > Karinui (.karinui); sidebar of the 3D view",
    "description": "Made-to-measure garments with their paper patterns: brought in, changed and draped anew",
    "category": "Import-Export",
}
_open = {}  # the processes by their document's path


class Preferences(bpy.types.AddonPreferences):
    bl_idname = __name__
    command: StringProperty(name="Command", description="The program karinui", default="karinui", subtype="FILE_PATH")

    def draw(self, _):
        self.layout.prop(self, "command")


def _command():
    addon = bpy.context.preferences.addons.get(__name__)
    return addon.preferences.command if addon else "karinui"


def _karinui(path):
    """The process that holds a document, started where there is none."""
    held = _open.get(path)
    if held and not held.alive:
        held.close()
    if held is None or not held.alive:
        language = "ja_JP.UTF-8" if bpy.app.translations.locale.startswith("ja") else "C.UTF-8"
        held = _open[path] = Karinui(path, _command(), language)
    return held


def _said(why):
    return pgettext(why.pattern).format(*why.values) if why.values else pgettext(str(why))


class Open(bpy.types.Operator, ImportHelper):
    """Bring in a garment, its body and its paper pattern"""

    bl_idname = "karinui.open"
    bl_label = "Karinui (.karinui)"
    bl_options = {"UNDO"}
    filename_ext = ".karinui"
    filter_glob: StringProperty(default="*.karinui", options={"HIDDEN"})

    def execute(self, context):
        path = str(pathlib.Path(self.filepath).resolve())
        known = [c for c in bpy.data.collections if c.get(garment.DOCUMENT) == path]
        collection = known[0] if known else bpy.data.collections.new(pathlib.Path(path).stem)
        try:
            garment.show(_karinui(path), collection)
        except Refused as why:
            if not known:
                bpy.data.collections.remove(collection)
            self.report({"ERROR"}, _said(why))
            return {"CANCELLED"}
        if not known:
            collection[garment.DOCUMENT] = path
            context.scene.collection.children.link(collection)
        return {"FINISHED"}


class Request(bpy.types.Operator):
    """What is asked of the active garment's document; then the garment is shown as it stands."""

    bl_options = {"UNDO"}

    @classmethod
    def poll(cls, context):
        return garment.document_of(context) is not None

    def request(self, _):
        raise NotImplementedError

    def begin(self, context):
        self.collection = garment.document_of(context)
        self.karinui = _karinui(self.collection[garment.DOCUMENT])
        what, fields = self.request(context)
        self.karinui.send(what, **fields)

    def finish(self, answer):
        garment.show(self.karinui, self.collection)
        if answer.get("settled") is False:
            self.report({"WARNING"}, answer["why"])
        for note in answer.get("notes", []):
            self.report({"INFO"}, note)
        return {"FINISHED"}

    def refuse(self, why):
        self.report({"ERROR"}, _said(why))
        return {"CANCELLED"}

    def execute(self, context):  # from a script: waits
        try:
            self.begin(context)
            answer = self.karinui.answer()
            while "progress" in answer:
                answer = self.karinui.answer()
            return self.finish(answer)
        except Refused as why:
            return self.refuse(why)

    def invoke(self, context, _):  # from the window: Blender goes on, Escape stops
        try:
            self.begin(context)
        except Refused as why:
            return self.refuse(why)
        self.timer = context.window_manager.event_timer_add(0.1, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type == "ESC":
            self.karinui.stop()
        if event.type != "TIMER":
            return {"PASS_THROUGH"}
        try:
            answer = self.karinui.answer(wait=0.001)
            while answer and "progress" in answer:
                context.workspace.status_text_set(f"{answer['doing']}  {answer['progress']:.0%}")
                answer = self.karinui.answer(wait=0.001)
            if answer is None:
                return {"RUNNING_MODAL"}
            done = self.finish(answer)
        except Refused as why:
            done = self.refuse(why)
        context.workspace.status_text_set(None)
        context.window_manager.event_timer_remove(self.timer)
        return done


class Drape(Request):
    """Bring the cloth to rest on the body"""

    bl_idname = "karinui.drape"
    bl_label = "Drape"

    def request(self, _):
        return "settle", {}


class Perform(Request):
    """Do an operation on the garment, a line such as: fabric name=denim piece=front"""

    bl_idname = "karinui.perform"
    bl_label = "Do"
    operation: StringProperty(name="Operation")

    def request(self, context):
        return "perform", {"operation": self.operation or context.scene.karinui_operation}


class Undo(Request):
    """Take back the last operation of the document"""

    bl_idname = "karinui.undo"
    bl_label = "Undo the operation"

    def request(self, _):
        return "undo", {}


class Redo(Request):
    """Do again what was taken back"""

    bl_idname = "karinui.redo"
    bl_label = "Redo the operation"

    def request(self, _):
        return "redo", {}


class Panel(bpy.types.Panel):
    bl_idname = "VIEW3D_PT_karinui"
    bl_label = "Karinui"
    bl_space_type, bl_region_type, bl_category = "VIEW_3D", "UI", "Karinui"

    def draw(self, context):
        layout = self.layout
        layout.operator(Open.bl_idname, text=pgettext_iface("Open a garment…"), icon="IMPORT")
        collection = garment.document_of(context)
        if collection is None:
            return
        layout.label(text=pathlib.Path(collection[garment.DOCUMENT]).name)
        layout.operator(Drape.bl_idname, icon="MOD_CLOTH")
        layout.prop(context.scene, "karinui_operation", text="")
        layout.operator(Perform.bl_idname)
        row = layout.row(align=True)
        row.operator(Undo.bl_idname, text=pgettext_iface("Undo"))
        row.operator(Redo.bl_idname, text=pgettext_iface("Redo"))


CLASSES = (Preferences, Open, Drape, Perform, Undo, Redo, Panel)


def _menu(self, _):
    self.layout.operator(Open.bl_idname)


def register():
    for one in CLASSES:
        bpy.utils.register_class(one)
    bpy.types.Scene.karinui_operation = StringProperty(
        name="Operation", description="A line such as: fabric name=denim piece=front")
    bpy.types.TOPBAR_MT_file_import.append(_menu)
    bpy.app.translations.register(__name__, WORDS)


def unregister():
    while _open:
        _open.popitem()[1].close()
    bpy.app.translations.unregister(__name__)
    bpy.types.TOPBAR_MT_file_import.remove(_menu)
    del bpy.types.Scene.karinui_operation
    for one in reversed(CLASSES):
        bpy.utils.unregister_class(one)
