# Reads exported files by programs that share no code with this one, and compares what they return with the area schedule.
import csv
import importlib
import json
import math
import os
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zipfile
import xml.etree.ElementTree as xml

PROGRAM, SOURCE = sys.argv[1], sys.argv[2]
SCENE = os.path.join(SOURCE, "scenes/start/quarter.json")
# What pages of proposals are made of, where somebody has built it.
SHELL = os.path.join(SOURCE, "build/web/proposal.html")


# The schedule has six decimals in each row; other files have all digits, so that sums over its rows differ from theirs by as much.
WRITTEN = 1e-7


def needs(command):
    return unittest.skipUnless(shutil.which(command), command + " is not installed")


def needs_module(name):
    try:
        importlib.import_module(name)
        return lambda test: test
    except ImportError:
        return unittest.skip("the Python module " + name + " is not installed")


def run(*arguments, page=None):
    surroundings = {**os.environ, "BEHAVIOURLINKS_PAGE": page} if page else None
    # admesh prints whatever stands in memory behind the head of a binary file.
    return subprocess.run(arguments, capture_output=True, text=True, errors="replace", timeout=600, env=surroundings)


def text_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return file.read()


def area(points):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(points, points[1:] + points[:1])) / 2


# A folder with exported files, and how they are compared with the area schedule.
class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp()

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder, name)

    @classmethod
    def read_schedule(cls):
        cls.rows = list(csv.DictReader(text_of(cls.path("a.csv")).splitlines(True)))
        cls.storeys, cls.buildings, cls.cellars = ([row for row in cls.rows if row["row"] == kind] for kind in ("storey", "building", "cellar"))

    def near(self, found, wanted, share):
        self.assertLessEqual(abs(found - wanted), share * max(1, abs(wanted)), (found, wanted))


class Export(Files):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        scene = json.loads(text_of(SCENE))
        # A place on Earth, for the formats that need one.
        scene["settings"].update({"coordinate_system": "EPSG:28992", "origin_x": 85000, "origin_y": 446000,
                                  "latitude": 51.9949, "longitude": 4.3716})
        scene["nodes"] += [
            {"id": "goal", "name": "Cost", "types": {"indicator": {"value": 3.6e7, "unit": "EUR", "target": 3e7, "direction": "at_most"}}},
            {"id": "free", "name": "Free", "types": {"plot": {}}},
            {"id": "park", "name": "Park", "types": {"plot": {"fsi_max": 0}}},
            {"id": "ground", "name": "Ground", "position": [15, 20, -3],
             "types": {"terrain": {"rows": [{"heights": "AAAABkADIAEs..."}] * 5, "north": 40}}}]
        scene["nodes"].sort(key=lambda node: node["id"])
        # Uses that spreadsheets take for one, since they compare texts without their case.
        next(node for node in scene["nodes"] if node["id"] == "office-2")["types"]["smart_volume"]["use"] = "Office"
        # Letters of western Europe that have no place in Latin-1.
        cls.title = "Cœur d’îlot – „Škoda“, 3 M€ …"
        scene["settings"]["title"] = cls.title
        cls.scene = os.path.join(cls.folder, "placed.json")
        with open(cls.scene, "w", encoding="utf-8") as file:
            json.dump(scene, file)
        cls.plans = os.path.join(cls.folder, "plans/")
        pairs = {"csv": "a.csv", "geojson": "a.geojson", "obj": "a.obj", "stl": "a.stl", "glb": "a.glb", "3mf": "a.3mf",
                 "dxf": "a.dxf", "svg": "plans/", "xlsx": "a.xlsx", "pdf": "a.pdf", "cityjson": "a.city.json", "ifc": "a.ifc"}
        help_text = run(PROGRAM, "export", "--help").stdout
        arguments = [PROGRAM, "export", cls.scene, "--settle", "--option", "surroundings=yes"]
        for name, file in pairs.items():
            if re.search(r"^  " + name + r" ", help_text, re.M):
                arguments += ["--format", name, "--out", os.path.join(cls.folder, file)]
        done = run(*arguments)
        assert done.returncode == 0, done.stdout + done.stderr
        cls.read_schedule()

    def number(self, row, name):
        return float(row[name])

    def test_csv_sums(self):
        self.assertGreater(len(self.storeys), len(self.buildings))
        for building in self.buildings:
            parts = [self.number(s, "floor_area [m2]") for s in self.storeys if s["building"] == building["building"]]
            self.near(math.fsum(parts), self.number(building, "floor_area [m2]"), 1e-9)
        for use in (row for row in self.rows if row["row"] == "use"):
            parts = [self.number(b, "floor_area [m2]") for b in self.buildings if b["use"] == use["use"]]
            self.near(math.fsum(parts), self.number(use, "floor_area [m2]"), 1e-9)
        every = [row for row in self.rows if row["row"] == "all"]
        self.near(math.fsum(self.number(b, "floor_area [m2]") for b in self.buildings), self.number(every[0], "floor_area [m2]"), 1e-9)
        self.assertTrue(all(row["hash"] == self.rows[0]["hash"] and row["tick"] for row in self.rows))

    def test_geojson_orientation_and_identity(self):
        document = json.loads(text_of(self.path("a.geojson")))
        self.assertEqual(document["scene"]["hash"], self.rows[0]["hash"])
        buildings = [f for f in document["features"] if f["properties"]["kind"] == "building"]
        self.assertEqual(len(buildings), len(self.buildings))
        for feature in document["features"]:
            shape = feature["geometry"]
            if shape["type"] == "LineString":
                continue
            for polygon in shape["coordinates"] if shape["type"] == "MultiPolygon" else [shape["coordinates"]]:
                self.assertEqual(polygon[0][0], polygon[0][-1])
                self.assertGreater(area(polygon[0][:-1]), 0)
                self.assertTrue(all(area(hole[:-1]) < 0 for hole in polygon[1:]))
                self.assertTrue(all(3 < p[0] < 8 and 50 < p[1] < 54 for p in polygon[0]))

    @needs("ogrinfo")
    @needs("ogr2ogr")
    def test_geojson_areas_in_metres(self):
        back = self.path("metres.geojson")
        done = run("ogr2ogr", "-f", "GeoJSON", "-lco", "COORDINATE_PRECISION=9", "-s_srs", "EPSG:4326", "-t_srs", "EPSG:28992",
                   back, self.path("a.geojson"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("Feature Count", run("ogrinfo", "-so", "-al", self.path("a.geojson")).stdout)
        for feature in json.loads(text_of(back))["features"]:
            if feature["properties"]["kind"] != "building":
                continue
            shape = feature["geometry"]
            found = 0
            for polygon in shape["coordinates"] if shape["type"] == "MultiPolygon" else [shape["coordinates"]]:
                x, y = polygon[0][0]
                found += sum(area([(p[0] - x, p[1] - y) for p in ring[:-1]]) for ring in polygon)
            self.near(found, feature["properties"]["drawn_area_m2"], 1e-6)

    def test_obj_and_glb_hold_the_same_bodies(self):
        names = [line[2:].strip() for line in text_of(self.path("a.obj")).splitlines() if line.startswith("o ")]
        self.assertEqual(len(names), len(self.buildings) + 1)
        self.assertEqual(names[-1], "terrain")
        with open(self.path("a.glb"), "rb") as file:
            data = file.read()
        magic, version, length, size, kind = struct.unpack("<4sIII4s", data[:20])
        self.assertEqual((magic, version, length, kind), (b"glTF", 2, len(data), b"JSON"))
        document = json.loads(data[20:20 + size])
        binary = data[28 + size:]
        self.assertEqual(len(binary), document["buffers"][0]["byteLength"])
        self.assertEqual(document["asset"]["extras"]["hash"], self.rows[0]["hash"])
        bodies = [node for node in document["nodes"] if "extras" in node]
        self.assertEqual([node["name"] for node in document["nodes"] if "extras" not in node], ["terrain"])
        self.assertEqual(len(bodies), len(self.buildings))
        for node in bodies:
            primitive = document["meshes"][node["mesh"]]["primitives"][0]
            places, corners = (document["accessors"][primitive[k]] if k == "indices" else
                               document["accessors"][primitive["attributes"]["POSITION"]] for k in ("POSITION", "indices"))
            def read(accessor, form):
                view = document["bufferViews"][accessor["bufferView"]]
                part = binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
                return list(struct.unpack("<%d%s" % (len(part) // 4, form), part))
            numbers, index = read(places, "f"), read(corners, "I")
            points = [tuple(numbers[k:k + 3]) for k in range(0, len(numbers), 3)]
            self.assertEqual([min(p[k] for p in points) for k in range(3)], places["min"])
            self.assertEqual(len(points), places["count"])
            triangles = [index[k:k + 3] for k in range(0, len(index), 3)]
            sides = {(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)}
            self.assertEqual(len(sides), 3 * len(triangles))
            self.assertTrue(all((b, a) in sides for a, b in sides))
            volume = sum(self.six_volumes(*(points[c] for c in t)) for t in triangles) / 6
            self.assertGreater(volume, 0.8 * node["extras"]["volume_m3"])
            self.assertLess(volume, 1.0001 * node["extras"]["volume_m3"])

    @staticmethod
    def six_volumes(a, b, c):
        return (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))

    def test_3mf_objects_are_closed(self):
        space = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
        with zipfile.ZipFile(self.path("a.3mf")) as package:
            self.assertIsNone(package.testzip())
            model = xml.fromstring(package.read("3D/3dmodel.model"))
        self.assertEqual(model.get("unit"), "millimeter")
        objects = list(model.iter(space + "object"))
        self.assertEqual(len(objects), len(self.buildings))
        for one in objects:
            triangles = [[int(t.get(k)) for k in ("v1", "v2", "v3")] for t in one.iter(space + "triangle")]
            sides = {(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)}
            self.assertEqual(len(sides), 3 * len(triangles))
            self.assertTrue(all((b, a) in sides for a, b in sides))
        hashes = [m.text for m in model.iter(space + "metadata") if m.get("name") == "bl:hash"]
        self.assertEqual(hashes, [self.rows[0]["hash"]])

    @needs("prusa-slicer")
    def test_3mf_in_a_slicer(self):
        text = run("prusa-slicer", "--info", self.path("a.3mf")).stdout
        self.assertNotIn("manifold = no", text)
        self.assertIn("manifold = yes", text)

    @needs("admesh")
    def test_stl_is_sound(self):
        text = run("admesh", self.path("a.stl")).stdout
        for word in ("Degenerate facets", "Edges fixed", "Facets removed", "Facets added", "Facets reversed", "Backwards edges"):
            self.assertRegex(text, word + r"\s*:\s*0\b")
        self.assertRegex(text, r"Total disconnected facets\s*:\s*0\s+0")
        self.assertRegex(text, r"Number of parts\s*:\s*%d\b" % len(self.buildings))
        # Millimetres at 1:500.
        volume = float(re.search(r"Volume\s*:\s*([\d.]+)", text).group(1)) / 8
        self.near(volume, self.mesh_volume_of_3mf() / 8, 1e-5)

    def mesh_volume_of_3mf(self):
        space = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
        with zipfile.ZipFile(self.path("a.3mf")) as package:
            model = xml.fromstring(package.read("3D/3dmodel.model"))
        volume = 0.0
        for one in model.iter(space + "object"):
            points = [tuple(float(v.get(k)) for k in "xyz") for v in one.iter(space + "vertex")]
            for t in one.iter(space + "triangle"):
                volume += self.six_volumes(*(points[int(t.get(k))] for k in ("v1", "v2", "v3"))) / 6
        return volume

    def shells_of(self, document, solid):
        scale, move = document["transform"]["scale"], document["transform"]["translate"]
        places = [[v[k] * scale[k] for k in range(3)] for v in document["vertices"]]
        for shell in solid:
            yield [[[places[i] for i in ring] for ring in surface] for surface in shell], shell

    def test_cityjson_solids_are_closed(self):
        document = json.loads(text_of(self.path("a.city.json")))
        self.assertEqual((document["type"], document["version"]), ("CityJSON", "2.0"))
        self.assertEqual(document["metadata"]["referenceSystem"], "https://www.opengis.net/def/crs/EPSG/0/28992")
        self.assertEqual(document["transform"]["translate"][:2], [85000, 446000])
        proposed = {name: one for name, one in document["CityObjects"].items() if name.startswith("building/")}
        self.assertEqual(len(proposed), len(self.buildings))
        for one in proposed.values():
            self.assertEqual([g["lod"] for g in one["geometry"]], ["1.2", "2.2"])
            for geometry in one["geometry"]:
                solids = geometry["boundaries"] if geometry["type"] == "MultiSolid" else [geometry["boundaries"]]
                volume = 0.0
                for solid in solids:
                    for surfaces, shell in self.shells_of(document, solid):
                        sides = [(a, b) for surface in shell for ring in surface for a, b in zip(ring, ring[1:] + ring[:1])]
                        self.assertEqual(len(sides), len(set(sides)))
                        self.assertEqual({(b, a) for a, b in sides}, set(sides))
                        for surface in surfaces:
                            for ring in surface:
                                volume += sum(self.six_volumes(ring[0], a, b) for a, b in zip(ring[1:], ring[2:])) / 6
                if geometry["lod"] == "2.2":
                    self.assertGreater(volume, 0.8 * one["attributes"]["volume_m3"])
                    self.assertLess(volume, 1.0001 * one["attributes"]["volume_m3"])
                    kinds = [k["type"] for k in geometry["semantics"]["surfaces"]]
                    self.assertEqual(kinds, ["GroundSurface", "WallSurface", "RoofSurface", "OuterCeilingSurface", "ClosureSurface"])

    def test_cityjson_is_read_back(self):
        back = self.path("back.json")
        done = run(PROGRAM, "import", self.path("a.city.json"), "--into", self.scene, "--out", back)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        count = sum("existing_building" in node.get("types", {}) for node in json.loads(text_of(back))["nodes"])
        self.assertEqual(count, len(self.buildings))

    def test_ifc_entities_and_quantities(self):
        lines = text_of(self.path("a.ifc")).splitlines()
        entities = {}
        for line in lines:
            found = re.match(r"(#\d+)=([A-Z0-9]+)\((.*)\);$", line)
            if found:
                self.assertNotIn(found.group(1), entities)
                entities[found.group(1)] = found.groups()[1:]
        count = lambda kind: sum(one[0] == kind for one in entities.values())
        self.assertEqual(count("IFCBUILDING"), len(self.buildings))
        self.assertEqual(count("IFCSPACE"), len(self.storeys))
        self.assertEqual(count("IFCBUILDINGSTOREY"), len(self.storeys))
        self.assertEqual((count("IFCPROJECT"), count("IFCSITE"), count("IFCMAPCONVERSION")), (1, 1, 1))
        # Whatever is named is there, and before it is named.
        for name, (kind, arguments) in entities.items():
            for other in re.findall(r"#\d+", re.sub(r"'(?:[^']|'')*'", "", arguments)):
                self.assertLess(int(other[1:]), int(name[1:]))
        names = [re.match(r"'([0-9A-Za-z_$]{22})'", one[1]).group(1) for one in entities.values() if one[1].startswith("'") and
                 re.match(r"'[0-9A-Za-z_$]{22}',\$", one[1])]
        self.assertEqual(len(names), len(set(names)))
        self.assertGreater(len(names), 3 * len(self.storeys))
        areas = sum(float(one[1].split(",")[3]) for one in entities.values()
                    if one[0] == "IFCQUANTITYAREA" and one[1].startswith("'GrossFloorArea'"))
        # Those of the spaces, and those of the buildings.
        self.near(areas, 2 * math.fsum(self.number(b, "floor_area [m2]") for b in self.buildings), WRITTEN)

    @needs_module("ezdxf")
    def test_dxf_audit_and_areas(self):
        import ezdxf
        document = ezdxf.readfile(self.path("a.dxf"))
        auditor = document.audit()
        self.assertEqual((len(auditor.errors), len(auditor.fixes)), (0, 0))
        self.assertEqual(document.units, 6)
        handles = [e.dxf.handle for e in document.entitydb.values()]
        self.assertEqual(len(handles), len(set(handles)))
        found = 0.0
        for line in document.modelspace().query("LWPOLYLINE"):
            if not re.match(r"L\d+-", line.dxf.layer):
                continue
            self.assertTrue(line.closed)
            points = [(p[0], p[1], p[4]) for p in line.get_points()]
            part = area([p[:2] for p in points])
            for a, b in zip(points, points[1:] + points[:1]):
                if a[2] == 0:
                    continue
                angle = 4 * math.atan(a[2])
                radius = math.dist(a[:2], b[:2]) / (2 * math.sin(angle / 2))
                part += radius * radius * (angle - math.sin(angle)) / 2
            found += part
        self.near(found, math.fsum(self.number(s, "drawn_area [m2]") for s in self.storeys), 1e-6)

    @needs("ogrinfo")
    def test_dxf_in_gdal(self):
        self.assertIn("Feature Count", run("ogrinfo", "-so", "-al", self.path("a.dxf")).stdout)

    def test_svg_areas(self):
        space = "{http://www.w3.org/2000/svg}"
        found = 0.0
        for name in sorted(name for name in os.listdir(self.plans) if name.startswith("level_")):
            root = xml.parse(os.path.join(self.plans, name)).getroot()
            self.assertEqual((root.get("width"), root.get("height"), root.get("viewBox")), ("420mm", "297mm", "0 0 420 297"))
            scale = float(re.search(r"scale 1:([\d.]+)", root.find(space + "desc").text).group(1))
            self.assertIn(self.rows[0]["hash"], root.find(space + "desc").text)
            for group in root.iter(space + "g"):
                if not group.get("id").startswith("use_"):
                    continue
                for path in group.iter(space + "path"):
                    rings = [[tuple(map(float, p.split())) for p in ring.strip("MZ").split("L")]
                             for ring in re.findall(r"M[^Z]*Z", path.get("d"))]
                    found -= sum(area(ring) for ring in rings) * (scale / 1000) ** 2
        self.near(found, math.fsum(self.number(s, "drawn_area [m2]") for s in self.storeys), 1e-6)

    @needs("xmllint")
    def test_svg_is_well_formed(self):
        files = [os.path.join(self.plans, name) for name in os.listdir(self.plans)]
        self.assertEqual(run("xmllint", "--noout", *files).returncode, 0)

    @needs("rsvg-convert")
    def test_svg_is_drawn(self):
        picture = self.path("plan.png")
        done = run("rsvg-convert", "-o", picture, os.path.join(self.plans, "level_00.svg"))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertGreater(os.path.getsize(picture), 10000)

    @needs_module("openpyxl")
    def test_xlsx_sums(self):
        import openpyxl
        values = openpyxl.load_workbook(self.path("a.xlsx"), data_only=True)
        formulas = openpyxl.load_workbook(self.path("a.xlsx"))
        self.assertEqual(values.sheetnames, ["Programme", "Buildings", "Storeys", "Plots", "Indicators", "Problems", "About"])
        indicators = list(values["Indicators"].iter_rows(min_row=2, values_only=True))
        wanted = [row for row in self.rows if row["row"] == "indicator"]
        # Behind them the gardens: the share of their area that has its sun.
        gardens = [row for row in self.rows if row["row"] == "sun"]
        self.assertEqual([row[0].split(": share of")[0] for row in indicators], [row["label"] for row in wanted + gardens])
        wanted += gardens
        for row, indicator in zip(indicators, wanted):
            self.near(row[1], self.number(indicator, "value"), 1e-6)
            self.near(row[5], self.number(indicator, "value") - self.number(indicator, "target"), 1e-6)
        rows = list(values["Buildings"].iter_rows(min_row=2, values_only=True))
        self.assertEqual(len(rows), len(self.buildings) + 1)
        for row, building in zip(rows, self.buildings):
            self.assertEqual(row[0], building["building"])
            self.near(row[5], self.number(building, "floor_area [m2]"), WRITTEN)
        self.near(rows[-1][5], math.fsum(self.number(b, "floor_area [m2]") for b in self.buildings), WRITTEN)
        storeys = list(values["Storeys"].iter_rows(min_row=2, values_only=True))
        self.near(storeys[-1][7], math.fsum(row[7] for row in storeys[:-1]), 1e-9)
        self.assertEqual(formulas["Buildings"].cell(len(rows) + 1, 6).value, "=SUM(F2:F%d)" % len(rows))
        # Where nothing may be built the rule is 0; where there is none, the cell is empty.
        plots = {row[0]: row[5:8] for row in values["Plots"].iter_rows(min_row=2, values_only=True)}
        self.assertEqual((plots["Free"], plots["Park"]), ((None, None, None), (0, None, None)))
        about = dict(row[:2] for row in values["About"].iter_rows(min_row=2, values_only=True))
        self.assertEqual(about["hash"], self.rows[0]["hash"])

    # As a spreadsheet calculates: EXACT knows cases, the equals sign does not.
    @needs_module("openpyxl")
    def test_xlsx_sums_by_name(self):
        import openpyxl
        values = openpyxl.load_workbook(self.path("a.xlsx"), data_only=True)
        formulas = openpyxl.load_workbook(self.path("a.xlsx"))
        column = lambda text: [row[0].value for row in values[text.split("!")[0]][text.split("!")[1].replace("$", "")]]
        count = 0
        for name in ("Programme", "Buildings"):
            for cell in (cell for row in formulas[name].iter_rows() for cell in row):
                if not str(cell.value).startswith("=SUMPRODUCT("):
                    continue
                exact = re.fullmatch(r"=SUMPRODUCT\(EXACT\(([^,]*),(\w+)\)\*([^)]*)\)", cell.value)
                plain = re.fullmatch(r"=SUMPRODUCT\(\(([^=]*)=(\w+)\)\*([^)]*)\)", cell.value)
                names, one, numbers = (exact or plain).groups()
                wanted = values[name][one].value
                is_same = lambda text: text == wanted if exact else text.lower() == wanted.lower()
                found = math.fsum(number for text, number in zip(column(names), column(numbers)) if is_same(text))
                self.near(found, values[name][cell.coordinate].value, 1e-9)
                count += 1
        self.assertGreater(count, len(self.buildings))
        self.assertLessEqual({"office", "Office"}, {row[0] for row in values["Programme"].iter_rows(values_only=True)})

    @needs("ssconvert")
    @needs_module("openpyxl")
    def test_xlsx_formulas_give_their_values(self):
        import openpyxl
        again = self.path("again.xlsx")
        self.assertEqual(run("ssconvert", "--recalc", self.path("a.xlsx"), again).returncode, 0)
        formulas = openpyxl.load_workbook(self.path("a.xlsx"))
        written = openpyxl.load_workbook(self.path("a.xlsx"), data_only=True)
        found = openpyxl.load_workbook(again, data_only=True)
        count = 0
        for sheet in formulas.sheetnames:
            for cell in (cell for row in formulas[sheet].iter_rows() for cell in row):
                if isinstance(cell.value, str) and cell.value.startswith("="):
                    count += 1
                    self.near(found[sheet][cell.coordinate].value, written[sheet][cell.coordinate].value, 1e-9)
        self.assertGreater(count, len(self.buildings))

    @needs("qpdf")
    def test_pdf_is_sound(self):
        done = run("qpdf", "--check", self.path("a.pdf"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    @needs("pdftotext")
    @needs("pdfinfo")
    def test_pdf_texts(self):
        text = run("pdftotext", "-layout", self.path("a.pdf"), "-").stdout
        self.assertIn(self.rows[0]["hash"], text)
        self.assertIn(self.title, text)
        self.assertIn("Title:           " + self.title, run("pdfinfo", self.path("a.pdf")).stdout)
        self.assertRegex(run("pdfinfo", self.path("a.pdf")).stdout, r"Page size:\s+1190\.5\d* x 841\.8\d*")


# A quarter that stands: whole storeys on footprints, with courtyards.
class Standing(Files):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        pairs = {"csv": "a.csv", "dxf": "a.dxf", "svg": "plans/", "ifc": "a.ifc"}
        if os.path.exists(SHELL):
            pairs["html"] = "a.html"
        arguments = [PROGRAM, "export", os.path.join(SOURCE, "scenes/start/standing.json"), "--settle"]
        for name, file in pairs.items():
            arguments += ["--format", name, "--out", os.path.join(cls.folder, file)]
        done = run(*arguments, page=os.path.dirname(SHELL))
        assert done.returncode == 0, done.stdout + done.stderr
        cls.read_schedule()

    def total(self, kind, column):
        return math.fsum(float(row[column]) for row in self.rows if row["row"] == kind)

    # Corners of a line with arcs, close to one another.
    @staticmethod
    def fine(line):
        points, out = [(p[0], p[1], p[4]) for p in line.get_points()], []
        for a, b in zip(points, points[1:] + points[:1]):
            out.append(a[:2])
            if a[2] == 0:
                continue
            angle = 4 * math.atan(a[2])
            x, y = b[0] - a[0], b[1] - a[1]
            far = 1 / math.tan(angle / 2) / 2
            middle = ((a[0] + b[0]) / 2 - y * far, (a[1] + b[1]) / 2 + x * far)
            for k in range(1, 200):
                turn = angle * k / 200
                u, v = a[0] - middle[0], a[1] - middle[1]
                out.append((middle[0] + u * math.cos(turn) - v * math.sin(turn), middle[1] + u * math.sin(turn) + v * math.cos(turn)))
        return out

    # Where a ring crosses a line through `start`, along it.
    @staticmethod
    def crossings(ring, start, along):
        found = []
        for a, b in zip(ring, ring[1:] + ring[:1]):
            left = [along[0] * (p[1] - start[1]) - along[1] * (p[0] - start[0]) for p in (a, b)]
            if (left[0] > 0) != (left[1] > 0):
                part = left[0] / (left[0] - left[1])
                found.append(sum((a[k] + (b[k] - a[k]) * part - start[k]) * along[k] for k in (0, 1)))
        return found

    # What a straight line through the plan crosses of all plates, measured in the plans, is as long as what the section shows.
    @needs_module("ezdxf")
    def test_section_cuts_what_the_plans_show(self):
        import ezdxf
        document = ezdxf.readfile(self.path("a.dxf"))
        auditor = document.audit()
        self.assertEqual((len(auditor.errors), len(auditor.fixes)), (0, 0))
        space = document.modelspace()
        line = space.query('LINE[layer=="SECTION-LINE"]')[0]
        x, y = line.dxf.start[0], line.dxf.start[1]
        along = (line.dxf.end[0] - x, line.dxf.end[1] - y)
        length = math.hypot(*along)
        along = (along[0] / length, along[1] / length)
        crossed = 0.0
        storeys = {}
        for plate in space.query("LWPOLYLINE"):
            if re.match(r"L\d+-", plate.dxf.layer):
                storeys.setdefault((plate.dxf.layer, plate.dxf.elevation), []).append(self.fine(plate))
        for rings in storeys.values():
            found = []
            for ring in rings:
                found += self.crossings(ring, (x, y), along)
            found.sort()
            self.assertEqual(len(found) % 2, 0)
            crossed += sum(b - a for a, b in zip(found[::2], found[1::2]))
        shown = 0.0
        for cut in space.query('LWPOLYLINE[layer=="SECTION-CUT"]'):
            across = [p[0] for p in cut.get_points()]
            shown += max(across) - min(across)
        self.assertGreater(shown, 100)
        self.assertLessEqual(abs(shown - crossed), 1e-3 * crossed)
        slabs = len(space.query('LWPOLYLINE[layer=="SECTION-SLAB"]'))
        self.assertEqual(slabs, 2 * len(space.query('LWPOLYLINE[layer=="SECTION-CUT"]')))
        heights = {t.dxf.text for t in space.query('TEXT[layer=="SECTION-TEXT"]')}
        self.assertIn("Section A", heights)
        self.assertTrue(any(re.match(r"\+\d+\.\d\d$", text) for text in heights))

    @needs("rsvg-convert")
    def test_section_is_drawn(self):
        picture = self.path("section.png")
        self.assertEqual(run("rsvg-convert", "-o", picture, self.path("plans/section.svg")).returncode, 0)
        self.assertGreater(os.path.getsize(picture), 10000)

    # Each storey is walled all around: the walls are as long as the perimeters of the spaces.
    def test_ifc_walls_go_round_the_storeys(self):
        entities = dict(re.findall(r"^(#\d+)=(.*);$", text_of(self.path("a.ifc")), re.M))
        sets = {}
        for entity in entities.values():
            found = re.match(r"IFCELEMENTQUANTITY\('[^']*',\$,'([^']*)',\$,\$,\(([^)]*)\)\)", entity)
            if found:
                for name in found.group(2).split(","):
                    kind, value = re.match(r"IFCQUANTITY[A-Z]+\('([^']*)',\$,\$,([^,]*),", entities[name]).groups()
                    sets.setdefault((found.group(1), kind), []).append(float(value))
        walls = sets["Qto_WallBaseQuantities", "Length"]
        self.assertEqual(len(walls), sum(entity.startswith("IFCWALL(") for entity in entities.values()))
        around = math.fsum(sets["Qto_SpaceBaseQuantities", "GrossPerimeter"])
        self.assertLessEqual(abs(math.fsum(walls) - around), 2e-3 * around)
        kinds = {kind for entity in entities.values() for kind in re.findall(r"^IFCWALL\('[^']*',\$,'[^']*',\$,'([^']*)'", entity)}
        self.assertGreaterEqual(len(kinds), 2)

    @unittest.skipUnless(os.path.exists(SHELL), "the page is not built (ui/web/build.sh)")
    def test_html_says_what_the_schedule_says(self):
        text = text_of(self.path("a.html"))
        self.assertLessEqual(len(text.encode()), 3000000)
        self.assertNotRegex(text, r"(?:src|href)=\"?(?:https?:)?//")
        page = json.loads(re.search(r'<script id="data" type="application/json">(.*?)</script>', text, re.S).group(1))
        self.assertEqual(dict(page["identity"])["hash"], self.rows[0]["hash"])
        # The row of all is the sum of the rows of storeys as they are written, each rounded by half of the sixth decimal at most.
        rounded = 0.5e-6 * (1 + sum(row["row"] == "storey" for row in self.rows))
        self.assertLessEqual(abs(page["all"]["area"] - self.total("all", "floor_area [m2]")), rounded)
        areas = math.fsum(storey["area"] for one in page["buildings"] for storey in one["storeys"])
        self.assertLessEqual(abs(areas - self.total("storey", "floor_area [m2]")), 1e-6 * areas)
        self.assertEqual(len(page["buildings"]), sum(row["row"] == "building" for row in self.rows))
        # The plans are drawn to a centimetre: areas from their paths, in decimetres.
        drawn = 0.0
        for one in page["buildings"]:
            for storey in one["storeys"]:
                drawn += abs(sum(area(ring) for ring in self.rings(page["paths"][storey["path"]]))) / 100
        self.assertLessEqual(abs(drawn - areas), 2e-3 * areas)

    @staticmethod
    def rings(path):
        x = y = 0.0
        rings, letter, numbers = [], "", []
        for token in re.findall(r"[mlz]|-?(?:\d+\.?\d*|\.\d+)", path):
            if token in "mlz":
                letter = token
                if letter == "z":
                    x, y = rings[-1][0]
                continue
            numbers.append(float(token))
            if len(numbers) == 2:
                x, y = x + numbers[0], y + numbers[1]
                numbers = []
                if letter == "m":
                    rings.append([])
                    letter = "l"
                rings[-1].append((x, y))
        return rings

    @unittest.skipUnless(os.path.exists(SHELL), "the page is not built (ui/web/build.sh)")
    @unittest.skipUnless(os.path.isdir(os.path.join(SOURCE, "ui/web/node_modules/playwright-core")), "playwright-core is not installed")
    @needs("node")
    @needs("chromium")
    def test_html_in_a_browser(self):
        done = run("node", os.path.join(SOURCE, "ui/web/test/proposal.mjs"), self.path("a.html"))
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_html_needs_a_built_page(self):
        done = run(PROGRAM, "export", os.path.join(SOURCE, "scenes/start/standing.json"), "--settle", "--max-ticks", "1", "--format", "html",
                   "--out", self.path("none.html"), page=self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("the page is not built", done.stdout + done.stderr)
        self.assertFalse(os.path.exists(self.path("none.html")))


# Volumes that stand over storeys below the ground: what all formats say of these, and that they count as nothing else.
class Cellars(Files):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        scene = os.path.join(SOURCE, "scenes/nodes/footprint.json")
        pairs = {"csv": "a.csv", "dxf": "a.dxf", "svg": "plans/", "pdf": "a.pdf", "ifc": "a.ifc", "cityjson": "a.city.json", "xlsx": "a.xlsx",
                 "glb": "a.glb", "obj": "a.obj", "3mf": "a.3mf", "stl": "a.stl"}
        if os.path.exists(SHELL):
            pairs["html"] = "a.html"
        cls.said = ""
        for pairs, options in ((pairs, []), ({"3mf": "with.3mf", "stl": "with.stl"}, ["--option", "cellars=true"]),
                               ({"glb": "without.glb"}, ["--option", "cellars=false"])):
            arguments = [PROGRAM, "export", scene, "--settle", *options]
            for name, file in pairs.items():
                arguments += ["--format", name, "--out", os.path.join(cls.folder, file)]
            done = run(*arguments, page=os.path.dirname(SHELL))
            assert done.returncode == 0, done.stdout + done.stderr
            cls.said += done.stdout + done.stderr
        cls.read_schedule()

    @staticmethod
    def total(rows, column="floor_area [m2]"):
        return math.fsum(float(row[column]) for row in rows)

    @staticmethod
    def volume(rows):
        return math.fsum(float(row["floor_area [m2]"]) * (float(row["top [m]"]) - float(row["bottom [m]"])) for row in rows)

    def test_csv_has_rows_of_their_own(self):
        self.assertEqual([(row["building"], row["storey"]) for row in self.cellars], [("flats", "-1"), ("flats", "-2"), ("shop", "-1")])
        self.near(self.total(self.storeys), self.total(self.buildings), 1e-9)
        self.assertTrue(all(float(row["top [m]"]) <= 1e-9 for row in self.cellars))

    def test_svg_has_a_plan_for_each(self):
        space = "{http://www.w3.org/2000/svg}"
        names = sorted(name for name in os.listdir(self.path("plans")) if name.startswith("cellar_"))
        self.assertEqual(names, ["cellar_01.svg", "cellar_02.svg"])
        for name in names:
            root = xml.parse(self.path("plans/" + name)).getroot()
            scale = float(re.search(r"scale 1:([\d.]+)", root.find(space + "desc").text).group(1))
            number = int(name[7:9])
            self.assertTrue(any(text.text.startswith("Cellar %d of 2, from -" % number) for text in root.iter(space + "text")))
            found = 0.0
            for group in root.iter(space + "g"):
                if group.get("id").startswith("use_"):
                    for path in group.iter(space + "path"):
                        for ring in re.findall(r"M[^Z]*Z", path.get("d")):
                            found -= area([tuple(map(float, p.split())) for p in ring.strip("MZ").split("L")]) * (scale / 1000) ** 2
            self.near(found, self.total([row for row in self.cellars if row["storey"] == str(-number)], "drawn_area [m2]"), 1e-6)

    @needs("pdftotext")
    def test_pdf_has_a_page_for_each(self):
        pages = run("pdftotext", "-layout", self.path("a.pdf"), "-").stdout.split("\f")
        levels = len(os.listdir(self.path("plans"))) - 1
        self.assertEqual(len([page for page in pages if page.strip()]), 1 + levels + 1)
        self.assertIn("cellars, not counted above", pages[0])
        self.assertIn("%.1f" % self.total(self.cellars), pages[0])
        self.assertIn("Cellar 2 of 2", pages[1])
        self.assertIn("Cellar 1 of 2", pages[2])
        self.assertIn("Level 0 of", pages[3])

    # In the plans with arcs; and what the section shows of them is as long as what it crosses in the plans.
    @needs_module("ezdxf")
    def test_dxf_plans_and_section(self):
        import ezdxf
        document = ezdxf.readfile(self.path("a.dxf"))
        auditor = document.audit()
        self.assertEqual((len(auditor.errors), len(auditor.fixes)), (0, 0))
        space = document.modelspace()
        line = space.query('LINE[layer=="SECTION-LINE"]')[0]
        x, y = line.dxf.start[0], line.dxf.start[1]
        length = math.dist((x, y), (line.dxf.end[0], line.dxf.end[1]))
        along = ((line.dxf.end[0] - x) / length, (line.dxf.end[1] - y) / length)
        found, crossed = 0.0, 0.0
        for plate in space.query("LWPOLYLINE"):
            if not re.match(r"L-\d+-", plate.dxf.layer):
                continue
            points = [(p[0], p[1], p[4]) for p in plate.get_points()]
            found += area([p[:2] for p in points])
            for a, b in zip(points, points[1:] + points[:1]):
                if a[2] != 0:
                    angle = 4 * math.atan(a[2])
                    radius = math.dist(a[:2], b[:2]) / (2 * math.sin(angle / 2))
                    found += radius * radius * (angle - math.sin(angle)) / 2
            at = Standing.crossings(Standing.fine(plate), (x, y), along)
            at.sort()
            crossed += sum(b - a for a, b in zip(at[::2], at[1::2]))
        self.near(found, self.total(self.cellars), 1e-6)
        shown = 0.0
        for cut in space.query('LWPOLYLINE[layer=="SECTION-CELLAR"]'):
            across = [p[0] for p in cut.get_points()]
            shown += max(across) - min(across)
        self.assertGreater(shown, 10)
        self.near(shown, crossed, 1e-3)

    def test_ifc_has_spaces_below_the_ground(self):
        entities = dict(re.findall(r"^(#\d+)=(.*);$", text_of(self.path("a.ifc")), re.M))
        spaces = [entity for entity in entities.values() if entity.startswith("IFCSPACE(")]
        self.assertEqual(len(spaces), len(self.storeys) + len(self.cellars))
        numbers = {}
        for entity in entities.values():
            value = re.match(r"IFCQUANTITY[A-Z]+\('([^']*)',\$,\$,([^,]*),", entity)
            if value:
                numbers.setdefault(value.group(1), []).append(float(value.group(2)))
        self.near(math.fsum(numbers["CellarArea"]), self.total(self.cellars), WRITTEN)
        # Those of the spaces, below the ground too, and those of the buildings, without these.
        self.near(math.fsum(numbers["GrossFloorArea"]), 2 * self.total(self.storeys) + self.total(self.cellars), WRITTEN)

    def test_cityjson_parts_are_closed(self):
        document = json.loads(text_of(self.path("a.city.json")))
        scale = document["transform"]["scale"]
        places = [[v[k] * scale[k] for k in range(3)] for v in document["vertices"]]
        parts = [one for one in document["CityObjects"].values() if one["type"] == "BuildingPart"]
        self.assertEqual(len(parts), len(self.cellars))
        volume = 0.0
        for one in parts:
            geometry = one["geometry"][0]
            for solid in geometry["boundaries"] if geometry["type"] == "MultiSolid" else [geometry["boundaries"]]:
                sides = [(a, b) for shell in solid for surface in shell for ring in surface for a, b in zip(ring, ring[1:] + ring[:1])]
                self.assertEqual({(b, a) for a, b in sides}, set(sides))
                for ring in (ring for shell in solid for surface in shell for ring in surface):
                    corners = [places[i] for i in ring]
                    volume += sum(Export.six_volumes(corners[0], a, b) for a, b in zip(corners[1:], corners[2:])) / 6
        self.near(volume, self.volume(self.cellars), 2e-3)

    @needs_module("openpyxl")
    def test_xlsx_has_a_sheet(self):
        import openpyxl
        rows = list(openpyxl.load_workbook(self.path("a.xlsx"), data_only=True)["Cellars"].iter_rows(min_row=2, values_only=True))
        self.assertEqual(len(rows), len(self.cellars) + 1)
        self.near(rows[-1][6], self.total(self.cellars), WRITTEN)

    @staticmethod
    def bodies_of_glb(path):
        with open(path, "rb") as file:
            data = file.read()
        size = struct.unpack("<I", data[12:16])[0]
        document, binary = json.loads(data[20:20 + size]), data[28 + size:]
        bodies = {}
        for node in document["nodes"]:
            primitive = document["meshes"][node["mesh"]]["primitives"][0]
            def read(accessor, form):
                view = document["bufferViews"][document["accessors"][accessor]["bufferView"]]
                part = binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]
                return list(struct.unpack("<%d%s" % (len(part) // 4, form), part))
            numbers, index = read(primitive["attributes"]["POSITION"], "f"), read(primitive["indices"], "I")
            points = [tuple(numbers[k:k + 3]) for k in range(0, len(numbers), 3)]
            bodies[node["name"]] = (node["extras"], points, [index[k:k + 3] for k in range(0, len(index), 3)])
        return bodies

    # A model in metres has them, each of them closed and below the ground.
    def test_glb_has_a_body_for_each_building_with_cellars(self):
        bodies = self.bodies_of_glb(self.path("a.glb"))
        self.assertEqual(sorted(bodies), ["Flats", "Flats, cellar", "Shop", "Shop, cellar"])
        for name, (extras, points, triangles) in bodies.items():
            sides = {(t[k], t[(k + 1) % 3]) for t in triangles for k in range(3)}
            self.assertEqual(len(sides), 3 * len(triangles))
            self.assertTrue(all((b, a) in sides for a, b in sides))
            volume = sum(Export.six_volumes(*(points[c] for c in t)) for t in triangles) / 6
            self.near(volume, extras["volume_m3"], 2e-3)
            if "cellar_of" not in extras:
                continue
            own = [row for row in self.cellars if row["building"] == extras["cellar_of"]]
            self.assertEqual(extras["storeys"], len(own))
            self.near(extras["cellar_area_m2"], self.total(own), WRITTEN)
            self.near(volume, self.volume(own), 2e-3)
            self.assertLessEqual(max(p[1] for p in points), 1e-6)
        self.assertEqual(sorted(self.bodies_of_glb(self.path("without.glb"))), ["Flats", "Shop"])
        names = [line[2:] for line in text_of(self.path("a.obj")).splitlines() if line.startswith("o ")]
        self.assertEqual(names, ["Flats", "Flats,_cellar", "Shop", "Shop,_cellar"])

    # A print stands on its plate: without cellars, unless somebody wants them.
    def test_prints_have_them_where_they_are_asked_for(self):
        space = "{http://schemas.microsoft.com/3dmanufacturing/core/2015/02}"
        found = {}
        for name in ("a", "with"):
            with zipfile.ZipFile(self.path(name + ".3mf")) as package:
                model = xml.fromstring(package.read("3D/3dmodel.model"))
            found[name] = 0.0
            for one in model.iter(space + "object"):
                points = [tuple(float(v.get(k)) for k in "xyz") for v in one.iter(space + "vertex")]
                for t in one.iter(space + "triangle"):
                    found[name] += Export.six_volumes(*(points[int(t.get(k))] for k in ("v1", "v2", "v3"))) / 6
        # Millimetres at 1:500.
        self.near(found["a"] / 8, self.volume(self.storeys), 2e-3)
        self.near(found["with"] / 8, self.volume(self.storeys) + self.volume(self.cellars), 2e-3)
        self.assertEqual(len(re.findall(r"without the cellars of 2\svolumes", self.said)), 3, self.said)

    @needs("admesh")
    def test_stl_with_cellars_is_sound(self):
        for name, parts in (("a", 2), ("with", 4)):
            text = run("admesh", self.path(name + ".stl")).stdout
            for word in ("Degenerate facets", "Facets removed", "Facets reversed", "Backwards edges"):
                self.assertRegex(text, word + r"\s*:\s*0\b")
            self.assertRegex(text, r"Total disconnected facets\s*:\s*0\s+0")

    @unittest.skipUnless(os.path.exists(SHELL), "the page is not built (ui/web/build.sh)")
    def test_html_has_plans_and_areas(self):
        page = json.loads(re.search(r'<script id="data" type="application/json">(.*?)</script>', text_of(self.path("a.html")), re.S).group(1))
        self.assertEqual([level["name"] for level in page["plan"]["levels"]][:3], ["Cellar 2", "Cellar 1", "Level 0"])
        cellars = [cellar for one in page["buildings"] for cellar in one["cellars"]]
        self.assertEqual(len(cellars), len(self.cellars))
        self.near(math.fsum(cellar["area"] for cellar in cellars), self.total(self.cellars), WRITTEN)
        drawn = math.fsum(abs(sum(area(ring) for ring in Standing.rings(page["paths"][cellar["path"]]))) / 100 for cellar in cellars)
        self.near(drawn, self.total(self.cellars), 2e-3)
        self.near(page["all"]["area"], self.total(self.storeys), WRITTEN)

    @unittest.skipUnless(os.path.exists(SHELL), "the page is not built (ui/web/build.sh)")
    @unittest.skipUnless(os.path.isdir(os.path.join(SOURCE, "ui/web/node_modules/playwright-core")), "playwright-core is not installed")
    @needs("node")
    @needs("chromium")
    def test_html_in_a_browser(self):
        done = run("node", os.path.join(SOURCE, "ui/web/test/proposal.mjs"), self.path("a.html"), "cellars")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
