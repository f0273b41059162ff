"""Checks that the stubs (__init__.pyi) have the names, signatures and defaults of the module."""

import ast
import inspect
import pathlib

import svnet

PACKAGE = pathlib.Path(svnet.__file__).parent
STUB = ast.parse((PACKAGE / "__init__.pyi").read_text())


def public(nodes, kind):
    return {node.name: node for node in nodes if isinstance(node, kind) and not node.name.startswith("_")}


def parameters(function):
    """[(name, default)] of a function of the stub, without self."""
    arguments = function.args
    names = [argument.arg for argument in arguments.args]
    assert not (arguments.posonlyargs or arguments.kwonlyargs or arguments.vararg or arguments.kwarg)
    defaults = [ast.literal_eval(default) for default in arguments.defaults]
    pairs = list(zip(names, [inspect.Parameter.empty] * (len(names) - len(defaults)) + defaults))
    return [pair for pair in pairs if pair[0] != "self"]


def real_parameters(function):
    found = inspect.signature(function).parameters.values()
    return [(parameter.name, parameter.default) for parameter in found if parameter.name != "self"]


def decorators(function):
    return [decorator.id for decorator in function.decorator_list]


def test_names():
    classes, functions = public(STUB.body, ast.ClassDef), public(STUB.body, ast.FunctionDef)
    assert sorted([*classes, *functions, "__version__"]) == sorted(svnet.__all__)
    (listed,) = (
        ast.literal_eval(node.value)
        for node in STUB.body
        if isinstance(node, ast.Assign) and node.targets[0].id == "__all__"
    )
    assert listed == svnet.__all__


def test_functions():
    for name, function in public(STUB.body, ast.FunctionDef).items():
        assert parameters(function) == real_parameters(getattr(svnet, name)), name
        assert function.returns is not None, name
        assert all(argument.annotation is not None for argument in function.args.args), name


def test_classes():
    for class_name, node in public(STUB.body, ast.ClassDef).items():
        real = getattr(svnet, class_name)
        methods = {f.name: f for f in node.body if isinstance(f, ast.FunctionDef)}
        if class_name != "Error":
            assert {name for name in vars(real) if not name.startswith("_")} == {
                name for name in methods if not name.startswith("_")
            }
        for name, method in methods.items():
            where = f"{class_name}.{name}"
            found = vars(real)[name]
            assert ("property" in decorators(method)) == isinstance(found, property), where
            assert ("staticmethod" in decorators(method)) == isinstance(found, staticmethod), where
            assert method.returns is not None, where
            if not isinstance(found, property):
                assert parameters(method) == real_parameters(getattr(real, name)), where


def test_every_public_member_has_a_docstring():
    for class_name in public(STUB.body, ast.ClassDef):
        for name, member in vars(getattr(svnet, class_name)).items():
            if not name.startswith("_"):
                assert inspect.getdoc(getattr(getattr(svnet, class_name), name)), f"{class_name}.{name}"


def test_the_package_is_marked_as_typed():
    assert (PACKAGE / "py.typed").is_file()
