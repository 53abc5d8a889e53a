"""Reads the animation that test_files wrote, by what the format says alone: python3
read_animation.py LIST.pvd"""

import base64
import pathlib
import struct
import sys
import xml.etree.ElementTree as xml

TYPES = {"Float64": "d", "Int64": "q", "UInt64": "Q"}


def numbers(array):
    """Inline binary data: in base64 a 64-bit count of bytes, then the numbers."""
    assert array.get("format") == "binary", array.attrib
    data = base64.b64decode("".join(array.itertext()).strip())
    (count,) = struct.unpack_from("<Q", data)
    assert len(data) == 8 + count, (len(data), count)
    code = TYPES[array.get("type")]
    return struct.unpack_from(f"<{count // 8}{code}", data, 8)


def arrays(parent):
    return {array.get("Name"): numbers(array) for array in parent.iter("DataArray")}


def check_piece(path, part):
    root = xml.parse(path).getroot()
    assert root.get("type") == "PolyData" and root.get("byte_order") == "LittleEndian"
    assert root.get("header_type") == "UInt64" and root.get("compressor") is None
    (piece,) = root.iter("Piece")
    points = int(piece.get("NumberOfPoints"))
    (positions,) = [numbers(array) for array in piece.find("Points")]
    assert len(positions) == 3 * points
    kind = "Lines" if part == "beams" else "Verts"
    cells = arrays(piece.find(kind))
    assert int(piece.get(f"NumberOf{kind}")) == len(cells["offsets"])
    assert cells["connectivity"] == tuple(range(points)) and cells["offsets"][-1] == points
    data = arrays(piece.find("PointData"))
    names = {
        "beams": {
            "force",
            "moment",
            "strain",
            "curvature",
            "force_mean",
            "moment_mean",
            "force_jump",
            "moment_jump",
        },
        "bodies": {"node", "velocity", "angular_velocity"},
        "joints": {"joint", "reaction_force", "reaction_moment"},
    }[part]
    assert set(data) == names | {"displacement", "axis_1", "axis_2", "axis_3"}, set(data)
    for name, values in data.items():
        assert len(values) == (1 if name in ("node", "joint") else 3) * points, name
    for i in range(points):
        axes = [data[f"axis_{k}"][3 * i : 3 * i + 3] for k in (1, 2, 3)]
        for a in range(3):
            for b in range(3):
                product = sum(x * y for x, y in zip(axes[a], axes[b]))
                assert abs(product - (a == b)) < 1e-12, (path, i, a, b)
    return points


def main():
    path = pathlib.Path(sys.argv[1])
    root = xml.parse(path).getroot()
    assert root.tag == "VTKFile" and root.get("type") == "Collection"
    found = {}
    for entry in root.find("Collection"):
        time, part = float(entry.get("timestep")), entry.get("name")
        points = check_piece(path.parent / entry.get("file"), part)
        found.setdefault(time, {})[part] = points
    # Two elements of six points, one body, a hinge and a clamp.
    assert list(found) == [0.0, 0.4, 1.0, 1.7, 2.9], found
    assert all(parts == {"beams": 12, "bodies": 1, "joints": 2} for parts in found.values()), found
    print("the animation is what its format says")


if __name__ == "__main__":
    main()
