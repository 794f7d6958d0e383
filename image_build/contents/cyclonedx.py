"""Makes the bill of materials: the image's contents, with versions, licences and the hash of each file, for other programs.

Format   CycloneDX 1.4, JSON: the oldest version that can express all of this, so that every tool reads it; Apache-2.0, as its schema.
         SPDX 2.3 could express the same; CycloneDX has package URLs and licence expressions where scanners for vulnerabilities look.
Source   https://cyclonedx.org/docs/1.4/json/; purl types "deb" and "generic" of https://github.com/package-url/purl-spec
Bytes    the same for the same image: time and number are the image's, not the clock's.
"""

import datetime
import hashlib
import json
import urllib.parse
import uuid

import copyright_file
from image_contents import MADE


def purl(package):
    quoted = urllib.parse.quote(package.version, safe=":")
    if package.built_here:
        return f"pkg:generic/{package.name}@{quoted}"
    return f"pkg:deb/debian/{package.name.replace('+', '%2B')}@{quoted}?arch={package.architecture}&distro=bookworm"


def source_component(name, version):
    quoted = urllib.parse.quote(version, safe=":")
    return {"type": "library", "name": name, "version": version,
            "purl": f"pkg:deb/debian/{name.replace('+', '%2B')}@{quoted}?arch=source&distro=bookworm"}


def licences(text):
    """The members of a component that have its licences: declared ones, or those that its text only refers to."""
    found = copyright_file.licences_of(text)
    if len(found) == 1 and " " not in found[0] and not found[0].startswith("LicenseRef-"):
        return {"licenses": [{"license": {"id": found[0]}}]}
    if found:
        return {"licenses": [{"expression": copyright_file.joined(found, "AND")}]}
    named = copyright_file.common_licences_of(text)
    return {"evidence": {"licenses": [{"license": {"name": f"refers to {name}"}} for name in named]}} if named else {}


def files_of(items):
    return [{"type": "file", "name": item.path, "hashes": [{"alg": "SHA-256", "content": item.sha256}]}
            for item in sorted(items, key=lambda item: item.path) if item.kind == "file"]


def component(package, text, properties):
    made = {"type": "library" if package.name.startswith("lib") else "application", "bom-ref": purl(package), "name": package.name,
            "version": package.version}
    if package.summary:
        made["description"] = package.summary
    made.update(licences(text))
    made["purl"] = purl(package)
    if not package.built_here:
        made["pedigree"] = {"ancestors": [source_component(package.source, package.source_version)]}
    made["properties"] = [{"name": f"frustumscreen:{name}", "value": value} for name, value in properties]
    return made


def dependencies(contents, packages, components):
    """The image depends on all components, a package on its dependencies that are in the image, and ours also on headers compiled in."""
    headers = [purl(package) for package, what in contents.compiled_in if what.startswith("headers:")]
    graph = {"image": [made["bom-ref"] for made in components]}
    for package in packages.values():
        needed = [purl(packages[name]) for name in package.depends if name in packages and name != package.name]
        graph[purl(package)] = sorted(needed + (headers if package.built_here else []))
    return [{"ref": ref, "dependsOn": needed} for ref, needed in graph.items()]


def make(contents, texts):
    """The bill of materials; texts: package -> (text of its copyright file, name of that text in licences.tar)."""
    by_package = {}
    for item in contents.items:
        by_package.setdefault(item.package, []).append(item)
    packages = {name: contents.database.packages[name] for name in sorted(set(by_package) - {MADE})}
    components = []
    for name, package in packages.items():
        text, place = texts[name]
        made = component(package, text, [("licence_text", place), *(("reason", reason) for reason in sorted({item.reason for item in by_package[name]}))])
        made["components"] = [{**source_component(*inside), "properties": [{"name": "frustumscreen:reason", "value": "linked in"}]}
                              for inside in package.inside] + files_of(by_package[name])
        components.append(made)
    for package, what in contents.compiled_in:
        text, place = texts[package.name]
        components.append(component(package, text, [("licence_text", place), ("reason", f"compiled into our programs: {what}")]))
    components.append({"type": "application", "bom-ref": "made-by-the-build", "name": "frustumscreen-image-settings",
                       "version": contents.version, "description": "settings, scripts and lists that no package has, made by the build",
                       "licenses": [{"license": {"id": "Apache-2.0"}}], "components": files_of(by_package.get(MADE, []))})
    image = {"type": "operating-system", "bom-ref": "image", "name": "frustumscreen-image", "version": contents.version}
    time = datetime.datetime.fromtimestamp(contents.time_s, datetime.timezone.utc)
    bill = {"bomFormat": "CycloneDX", "specVersion": "1.4", "version": 1,
            "metadata": {"timestamp": time.strftime("%Y-%m-%dT%H:%M:%SZ"),
                         "tools": [{"vendor": "FrustumScreen", "name": "write_bill.py", "version": contents.version}], "component": image},
            "components": components,
            "dependencies": dependencies(contents, packages, components)}
    number = uuid.uuid5(uuid.NAMESPACE_URL, hashlib.sha256(json.dumps(bill, sort_keys=True).encode("utf-8")).hexdigest())
    return {**bill, "serialNumber": f"urn:uuid:{number}"}
