"""ICC profiles made by hand: three curves and a matrix, and damaged ones."""

import io
import struct

from PIL import ImageCms

# Primaries adapted to D50, as columns of XYZ.
WIDE = (0.60974, 0.31111, 0.01947), (0.20528, 0.62567, 0.06087), (0.14919, 0.06322, 0.74457)  # Adobe RGB's
SWAPPED = (0.14307, 0.06061, 0.71410), (0.38515, 0.71687, 0.09708), (0.43607, 0.22249, 0.01392)  # sRGB's, blue first


def fixed(value):
    return struct.pack(">i", round(value * 65536))


def gamma_curve(exponent):
    return b"curv\0\0\0\0" + struct.pack(">IH", 1, round(exponent * 256))


def sampled_curve(values):
    return b"curv\0\0\0\0" + struct.pack(f">I{len(values)}H", len(values), *(round(v * 65535) for v in values))


def parametric_curve(form, *values):
    return b"para\0\0\0\0" + struct.pack(">HH", form, 0) + b"".join(map(fixed, values))


def matrix_profile(title="Wide", primaries=WIDE, curve=None, space=b"RGB "):
    """The bytes of a profile of a screen."""
    curve = gamma_curve(2.2) if curve is None else curve
    text = title.encode() + b"\0"
    tags = {b"desc": b"desc\0\0\0\0" + struct.pack(">I", len(text)) + text + bytes(78)}
    tags[b"wtpt"] = b"XYZ \0\0\0\0" + b"".join(map(fixed, (0.9642, 1.0, 0.8249)))
    for name, column in zip((b"rXYZ", b"gXYZ", b"bXYZ"), primaries, strict=True):
        tags[name] = b"XYZ \0\0\0\0" + b"".join(map(fixed, column))
    tags |= dict.fromkeys((b"rTRC", b"gTRC", b"bTRC"), curve)
    at, table, data = 128 + 4 + 12 * len(tags), struct.pack(">I", len(tags)), b""
    for name, body in tags.items():
        body += bytes(-len(body) % 4)
        table += struct.pack(">4sII", name, at + len(data), len(body))
        data += body
    head = bytearray(128)
    struct.pack_into(">I4sI4s4s4s", head, 0, at + len(data), b"\0\0\0\0", 0x02400000, b"mntr", space, b"XYZ ")
    head[36:40] = b"acsp"
    head[68:80] = b"".join(map(fixed, (0.9642, 1.0, 0.8249)))
    return bytes(head) + table + data


def srgb_bytes():
    return ImageCms.ImageCmsProfile(ImageCms.createProfile("sRGB")).tobytes()


def lcms(profile, picture, target="sRGB"):
    """What LittleCMS makes of a picture of Pillow."""
    source = ImageCms.getOpenProfile(io.BytesIO(profile))
    made = ImageCms.buildTransform(source, ImageCms.createProfile(target), picture.mode, "RGB", 1)
    return ImageCms.applyTransform(picture, made)
