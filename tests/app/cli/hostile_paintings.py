"""Paintings whose manifests and members lie, by what is wrong with them."""

import hashlib
import json
from collections.abc import Iterator
from typing import Any

from hostile import BEFORE, DEEPEST, HALF, RIGHT, WRONG, Commands, layer, members_of, placed, put, select, stroke

# ---- files of paintings ----

MANIFEST, AGAIN = "inkfall/manifest.json", "inkfall/manifest-again.json"
# A painting that holds all of it.
HELD: Commands = [
    {"do": "texture", "name": "t", "maker": "image", "path": "spots.png"},
    *BEFORE,
    layer("add", "C", kind="picture", texture="t", at=[4, 4]),
    layer("set", "C", role="reference"),
    layer("add", "W"),
    layer("set", "W", wrap=[0, 0, 0, 32, 32]),
    select(none=True),
    stroke(layer="W"),
    layer("set", "A", mask="kept"),
    layer("set", "B", clip=True),
    layer("add", "G", kind="group", group=None),
    layer("add", "D", group="G"),
    stroke([9, 9], brush={"ink": [{"texture": "ramp"}]}),
    placed("P", "D", group="G", c=[0.6, 0.8], rect=[0, 0, 0, 30, 30]),
    placed("R", "D", group="G", rect=[0, 0, 0, 16, 16], repeat=True),
    placed("loop", None, group=None, **HALF),
    RIGHT["guide"],
    RIGHT["bookmark"],
    {"do": "paper", "colour": "#f0e0d0"},
    select(ellipse=[1, 10, 10, 30, 30]),
]
TOLD = ("layers", "selections", "guides", "paper", "frame", "textures", "pictures", "bookmarks")


def wrong_manifests(members: dict[str, bytes]) -> Iterator[tuple[str, dict[str, bytes]]]:
    """What to change of a painting's members for one thing that its manifest tells to be wrong, by name."""
    manifest = json.loads(members[MANIFEST])
    for part in TOLD:
        told = manifest[part]
        for path in [(), *members_of(told)] if isinstance(told, dict | list) else [()]:
            at = ".".join(map(str, (part, *path)))
            for value in WRONG:
                changed = put(manifest, (part, *path), value)
                yield f"{at} {str(value)[:9]}", {MANIFEST: json.dumps(changed).encode()}
            gone = put(manifest, (part, *path), None, gone=True)
            yield f"no {at}", {MANIFEST: json.dumps(gone).encode()}


def _nodes(told: list[Any]) -> Iterator[dict[str, Any]]:
    for node in told:
        yield node
        yield from _nodes(node.get("children", []))


def _with(members: dict[str, bytes], name: str, **changes: Any) -> dict[str, bytes]:
    """The manifest with other members of one node."""
    manifest = json.loads(members[MANIFEST])
    next(node for node in _nodes(manifest["layers"]) if node["name"] == name).update(changes)
    return {MANIFEST: json.dumps(manifest).encode()}


def _summed(members: dict[str, bytes], changes: dict[str, bytes]) -> dict[str, bytes]:
    """Members that are changed, with a manifest that agrees to it."""
    manifest = json.loads(members[MANIFEST])
    for name, data in changes.items():
        manifest["members"][name] = [len(data), hashlib.sha256(data).hexdigest()]
    return {**changes, MANIFEST: json.dumps(manifest).encode()}


def _many(members: dict[str, bytes], nodes: list[dict[str, Any]]) -> dict[str, bytes]:
    manifest = json.loads(members[MANIFEST])
    common = {"opacity": 1.0, "visible": True, "blend": "src-over", "locked": False}
    manifest["layers"] += [{"id": 1000 + i, "name": f"n{i}", **common, **told} for i, told in enumerate(nodes)]
    return {MANIFEST: json.dumps(manifest).encode()}


def lying(members: dict[str, bytes]) -> dict[str, dict[str, bytes]]:
    """What to change of a painting's members, by what is wrong then."""
    ids = {node["name"]: node["id"] for node in _nodes(json.loads(members[MANIFEST])["layers"])}
    selection = next(name for name in members if name.startswith("inkfall/selections/"))
    tiles = next(name for name in members if name.startswith("inkfall/layers/") and name.endswith(".tiles"))
    a_link = {"kind": "placement", "source": ids["A"]}
    chain = [{**a_link, "source": 999 + i if i else ids["A"], "at": [1, 0]} for i in range(3000)]
    out = {
        "a placement of itself": _with(members, "P", source=ids["P"]),
        "a placement of itself at scale 1": _with(members, "loop", levels=0),
        "a loop without its rect": _with(members, "loop", rect=None),
        "a loop that is repeated": _with(members, "loop", repeat=True),
        "a loop that is multiplied": _with(members, "loop", blend="multiply"),
        "a placement of the group it is in": _with(members, "P", source=ids["G"]),
        "two of one another": {**_with(members, "P", source=ids["R"])},
        "a placement of nobody": _with(members, "P", source=1 << 40),
        "a mask of a placement": _selected(members, masks=ids["P"]),
        "a selection of no name": _selected(members, name=[1]),
        "a mask of nobody": _selected(members, masks=1 << 40),
        "a mask of the painting": _selected(members, masks=0),
        "a selection of a layer's tiles": _selected(members, packs=json.loads(members[MANIFEST])["layers"][0]["packs"]),
        "a selection twice": _twice(members),
        "4,097 selections": _selections(members, 4097),
        "a selection that is a picture": _summed(members, {selection: members["mergedimage.png"]}),
        "a selection that is cut": _summed(members, {selection: members[selection][:-20]}),
        "a selection that is empty": _summed(members, {selection: b""}),
        "a selection of a layer's bytes": _summed(members, {selection: members[tiles]}),
        "a layer of a selection's bytes": _summed(members, {tiles: members[selection]}),
        "a torus without sides": _with(members, "W", wrap=[0, 0, 0, 0, 0]),
        "a torus of 10^9 px": _with(members, "W", wrap=[0, 0, 0, 10**9, 10**9]),
        "a torus of 2^-4096 px": _with(members, "W", wrap=[DEEPEST, 0, 0, 1, 1]),
        "a torus of 2^4096 px": _with(members, "W", wrap=[-DEEPEST, 0, 0, 1, 1]),
        "a role that is none": _with(members, "C", role="height map"),
        "a group of a role": _with(members, "G", role="reference"),
        "a group with a torus": _with(members, "G", wrap=[0, 0, 0, 9, 9]),
        "a chain of 3,000": _many(members, chain),
        "3,000 of one layer": _many(members, [{**a_link, "at": [i % 60, i // 60]} for i in range(3000)]),
        "20,000 of one layer": _many(members, [{**a_link, "at": [i % 60, i // 60]} for i in range(20_000)]),
        "a fan of 2^20": _many(members, _file_fan(ids["A"], 20)),
        "groups 100 deep": _many(members, [_deep(100)]),
        "groups 5,000 deep": {MANIFEST: b'{"layers": ' + b'[{"children": ' * 5000 + b"[]" + b"}]" * 5000 + b"}"},
    }
    for name in members:
        if name.startswith("inkfall/") and name not in (MANIFEST, AGAIN):
            out[f"{name} cut"] = {name: members[name][: len(members[name]) // 2]}
            out[f"{name} a picture"] = _summed(members, {name: members["mergedimage.png"]})
    return out


def _file_fan(of: int, count: int) -> list[dict[str, Any]]:
    common = {"opacity": 1.0, "visible": True, "blend": "src-over", "locked": False}
    out = []
    for i in range(count):
        inner = [
            {
                "kind": "placement",
                "id": 5000 + 2 * i + side,
                "name": f"f{i} {side}",
                "source": of,
                "at": [side * 7, i],
                **common,
            }
            for side in (0, 1)
        ]
        out.append({"kind": "group", "isolated": False, "visible": i == count - 1, "children": inner})
        of = 1000 + i
    return out


def _deep(count: int) -> dict[str, Any]:
    told: dict[str, Any] = {"kind": "group", "isolated": False, "children": []}
    for i in range(count):
        common = {"opacity": 1.0, "visible": True, "blend": "src-over", "locked": False}
        told = {"kind": "group", "isolated": False, "children": [{**common, "id": 9000 + i, "name": f"d{i}", **told}]}
    return told


def _selected(members: dict[str, bytes], **changes: Any) -> dict[str, bytes]:
    manifest = json.loads(members[MANIFEST])
    one = next(one for one in manifest["selections"] if "name" not in one)
    one.update(changes)
    return {MANIFEST: json.dumps(manifest).encode()}


def _twice(members: dict[str, bytes]) -> dict[str, bytes]:
    manifest = json.loads(members[MANIFEST])
    manifest["selections"] *= 2
    return {MANIFEST: json.dumps(manifest).encode()}


def _selections(members: dict[str, bytes], count: int) -> dict[str, bytes]:
    manifest = json.loads(members[MANIFEST])
    manifest["selections"] = [{**manifest["selections"][0], "name": f"s{i}", "packs": []} for i in range(count)]
    return {MANIFEST: json.dumps(manifest).encode()}
