"""Prints docs/python-reference.md: signatures from the type stubs, texts from the docstrings of the built module.

PYTHONPATH=build/release/python python3 apps/python/pages/python_reference.py
"""

import ast
import pathlib
import re

import brisance

STUBS = pathlib.Path(__file__).parent.parent / "brisance" / "__init__.pyi"
HEAD = """# Python, name by name

Generated from the module's type stubs and docstrings; a test compares it with them. [python.md](python.md) says how things
work together. Arrays are NumPy's, with their shapes in brackets; n counts whatever the array is about.
"""


def shown(node):
    """An annotation as a reader wants it."""
    text = ast.unparse(node).replace("_Float32", "float32 array").replace("_Float64", "float64 array")
    text = re.sub(r"NDArray\[np\.(\w+)\]", r"\1 array", text)
    text = re.sub(r"Optional\[(.*?)\]", r"\1 or None", text)
    return text.replace("_Path", "path").replace("_Vector", "(x, y, z)").replace("ArrayLike", "array")


def argument(arg, default):
    text = arg.arg + (f": {shown(arg.annotation)}" if arg.annotation else "")
    return text + (f" = {ast.unparse(default)}" if default else "")


def signature(function, name):
    given = function.args
    plain = [arg for arg in given.args if arg.arg not in ("self", "cls")]
    defaults = [None] * (len(plain) - len(given.defaults)) + given.defaults
    words = [argument(*pair) for pair in zip(plain, defaults)]
    if given.kwonlyargs:
        words += ["*"] + [argument(*pair) for pair in zip(given.kwonlyargs, given.kw_defaults)]
    if given.kwarg:
        words.append(f"**{given.kwarg.arg}")
    result = "" if name[0].isupper() or ast.unparse(function.returns) == "None" else f" -> {shown(function.returns)}"
    return f"{name}({', '.join(words)}){result}"


def text_of(thing):
    """The docstring without the signature that pybind11 puts above it."""
    text = re.sub(r"^\w+\(.*\)( -> .*)?\n+", "", (thing.__doc__ or "").strip())
    return " ".join(text.split())


def decorators(function):
    return [ast.unparse(one) for one in function.decorator_list]


def entry(heading, text):
    return f"\n- `{heading}`  \n  {text}\n"


def members(node, kind):
    for member in node.body:
        if isinstance(member, ast.FunctionDef) and (member.name == "__init__" or not member.name.startswith("_")):
            thing = getattr(kind, member.name)
            if "property" in decorators(member):
                yield entry(f"{member.name}: {shown(member.returns)}", text_of(thing))
            elif member.name == "__init__":
                yield entry(signature(member, node.name), text_of(thing))
            else:
                prefix = f"{node.name}." if "staticmethod" in decorators(member) else ""
                yield entry(prefix + signature(member, member.name), text_of(thing))


def class_section(node):
    kind = getattr(brisance, node.name)
    bases = [ast.unparse(base) for base in node.bases]
    also = f" A kind of {', '.join(f'`{base}`' for base in bases)}." if bases else ""
    return f"\n## {node.name}\n\n{text_of(kind)}{also}\n" + "".join(members(node, kind))


def document():
    tree = ast.parse(STUBS.read_text())
    functions = [node for node in tree.body if isinstance(node, ast.FunctionDef)]
    text = HEAD + "\n## Functions\n"
    for node in functions:
        text += entry(signature(node, f"brisance.{node.name}"), text_of(getattr(brisance, node.name)))
    return text + "".join(class_section(node) for node in tree.body if isinstance(node, ast.ClassDef))


if __name__ == "__main__":
    print(document(), end="")
