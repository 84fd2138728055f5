"""stack.xml: what other programs write, what they need, and what lies."""

import contextlib
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from engine.files.fault import FileError
from engine.files.limits import LIMITS
from engine.files.stack_xml import OURS, ImageEntry, LayerEntry, StackEntry, parse_stack, printable, stack_text


def parsed(text, **limits):
    return parse_stack(text.encode() if isinstance(text, str) else text, "a.ora", replace(LIMITS, **limits))


def image(inside, attributes='w="8" h="6"'):
    return f"<image {attributes}><stack>{inside}</stack></image>"


def layer(attributes):
    return parsed(image(f'<layer src="data/0.png" {attributes}/>')).root.children[0]


def test_a_tree():
    found = parsed(
        image(
            '<layer src="/data/a.png" name="top" x="-3" y="5" opacity="0.25" visibility="hidden"'
            ' composite-op="svg:multiply" edit-locked="true" selected="true"/>'
            '<stack name="group" isolation="isolate"><layer src="data/b.png"/><stack/></stack>'
        )
    )
    assert (found.width, found.height, found.notes) == (8, 6, ())
    top, group = found.root.children
    assert top == LayerEntry("data/a.png", "top", -3, 5, 0.25, False, "svg:multiply", True, True)
    assert group.isolated
    assert group.children[0] == LayerEntry("data/b.png", "")
    assert group.children[1].children == ()
    assert [entry.src for entry in found.root.layers()] == ["data/a.png", "data/b.png"]


@pytest.mark.parametrize(
    ("attributes", "isolated"),
    [
        ("", False),
        ('isolation="auto"', False),
        ('isolation="isolate"', True),
        ('opacity="0.5"', True),
        ('isolation="auto" composite-op="svg:multiply"', True),
    ],
)
def test_isolation(attributes, isolated):
    assert parsed(image(f"<stack {attributes}/>")).root.children[0].isolated is isolated


@pytest.mark.parametrize(
    ("attributes", "field", "value"),
    [
        ("", "op", "svg:src-over"),
        ('composite-op="krita:pass"', "op", "krita:pass"),
        ('opacity="7"', "opacity", 1.0),
        ('opacity="-7"', "opacity", 0.0),
        ('opacity="1e999"', "opacity", 1.0),
        ('x="12.0"', "x", 12),
        ('x=" -4 "', "x", -4),
        ('x=""', "x", 0),
        ('edit-locked="maybe"', "locked", False),
    ],
)
def test_attributes_are_forgiven(attributes, field, value):
    assert getattr(layer(attributes), field) == value


@pytest.mark.parametrize("attributes", ['opacity="nan"', 'opacity="x"', 'opacity="1_0"', 'visibility="no"'])
def test_what_is_replaced_is_told(attributes):
    found = parsed(image(f'<layer src="a.png" name="L" {attributes}/>'))
    assert found.root.children[0].opacity == 1.0
    assert found.notes[0].startswith("layer 'L': ")


def test_a_layer_without_a_picture_is_left_out():
    found = parsed(image('<layer name="L"/>'))
    assert found.root.children == ()
    assert "left out" in found.notes[0]


def test_unknown_elements_are_passed_over():
    found = parsed(
        '<image w="1" h="1" xmlns:z="urn:z"><z:before><stack/></z:before><stack><filter><layer src="x"/></filter>'
        '<layer src="a"><z:in/></layer>text</stack><z:after/></image>'
    )
    assert [entry.src for entry in found.root.layers()] == ["a"]


NESTED = "<stack>" * 70 + "</stack>" * 70
ENTITY = '<!DOCTYPE image [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;">]>'
HOSTILE = {
    "nothing": ("", "not XML"),
    "not XML": ("hello", "not XML"),
    "cut short": ("<image w='1' h='1'><stack>", "not XML"),
    "not an image": ("<svg/>", "expected image"),
    "no stack": ("<image w='1' h='1'/>", "no root stack"),
    "two stacks": ("<image w='1' h='1'><stack/><stack/></image>", "second root"),
    "default namespace": ("<image xmlns='urn:x' w='1' h='1'><stack/></image>", "expected image"),
    "entities": (ENTITY + image('<layer src="a" name="&b;"/>'), "entities"),
    "external entity": (
        '<!DOCTYPE image [<!ENTITY e SYSTEM "file:///etc/passwd">]>' + image('<layer src="a" name="&e;"/>'), "entities"
    ),
    "document type": ('<!DOCTYPE image SYSTEM "http://localhost/x.dtd">' + image(""), "document type"),
    "no size": ("<image><stack/></image>", "attribute w"),
    "negative size": (image("", 'w="-5" h="1"'), "found '-5'"),
    "zero size": (image("", 'w="0" h="1"'), "whole number"),
    "other digits": (image("", 'w="٤" h="1"'), "whole number"),
    "underscore": (image("", 'w="4_0" h="1"'), "whole number"),
    "exponent": (image("", 'w="1e3" h="1"'), "whole number"),
    "huge size": (image("", f'w="{10**30}" h="1"'), "whole number"),
    "infinite place": (image('<layer src="a" x="inf"/>'), "attribute x"),
    "far place": (image(f'<layer src="a" y="{1 << 40}"/>'), "attribute y"),
    "deep": (image(NESTED), "64 deep"),
    "deep and unknown": (image(NESTED.replace("stack", "other")), "64 deep"),
    "many layers": (image('<layer src="a"/>' * 2001), "2000 layers"),
    "many elements": (image("<z/>" * 20001), "20000 elements"),
    "long name": (image(f'<layer src="a" name="{"x" * 5000}"/>'), "5000 characters"),
    "unknown encoding": (b'<?xml version="1.0" encoding="x-none"?><image/>', "not XML"),
    "bytes that are not UTF-8": (b"<image w='1' h='1'><stack name='\xff'/></image>", "not XML"),
}  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile(name):
    text, expected = HOSTILE[name]
    with pytest.raises(FileError) as caught:
        parsed(text)
    assert str(caught.value).startswith("a.ora: stack.xml")
    assert expected in str(caught.value)
    assert str(caught.value).isprintable()


TREE = ImageEntry(
    8,
    6,
    StackEntry(
        (
            LayerEntry("data/1.png", 'a <b> & "c"', -3, 5, 0.1, False, "svg:screen", True, True, {"id": "7"}),
            StackEntry((LayerEntry("data/2.png", "d"),), "g", 0.5, True, "svg:multiply", True, True, {"kind": "x"}),
            StackEntry((), "pass", isolated=False),
        ),
        isolated=True,
    ),
    {"format": "1"},
)


def test_round_trip():
    back = parsed(stack_text(TREE))
    assert back.root.children == TREE.root.children
    assert back.ours == {"format": "1"}
    assert back.notes == ()


def test_what_other_readers_need():
    """MyPaint takes a missing mode for pigment, GIMP and PyORA want no default namespace, Krita reads isolation."""
    text = stack_text(TREE).decode()
    assert 'mypaint:eotf="1.0"' in text
    assert f'xmlns:inkfall="{OURS}"' in text
    assert " xmlns=" not in text
    for line in text.splitlines():
        if "<layer" in line:
            assert all(f" {key}=" in line for key in ("src", "x", "y", "name", "opacity", "visibility", "composite-op"))
        if "<stack " in line:
            assert " isolation=" in line
            assert " x=" not in line


@settings(deadline=None, max_examples=60)
@given(st.text(max_size=20), st.floats(0, 1))
def test_any_name_and_opacity_survive(name, opacity):
    tree = replace(TREE, root=StackEntry((LayerEntry("a", name, opacity=opacity),), isolated=True))
    back = parsed(stack_text(tree)).root.children[0]
    assert back.opacity == opacity
    assert back.name.split() == printable(name).split()


@settings(deadline=None, max_examples=200)
@given(st.lists(st.floats(0, 0.99999), min_size=1, max_size=4))
def test_flipped_bits_raise_nothing_else(places):
    data = bytearray(stack_text(TREE))
    for place in places:
        bit = int(place * 8 * len(data))
        data[bit // 8] ^= 1 << bit % 8
    with contextlib.suppress(FileError):
        parsed(bytes(data))
