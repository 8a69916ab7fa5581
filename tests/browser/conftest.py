"""A real JupyterLab and a real Chromium, each started once for all browser tests."""

import json
import os
import re
import shutil
import socket
import subprocess
import sys
import time
import urllib.request
from pathlib import Path

import pytest
from tools.pages import BEGUN

ROOT = Path(__file__).resolve().parent.parent.parent
FLAGS = "--no-sandbox --disable-gpu --no-first-run --disable-background-networking --disable-sync".split()
NO_NEWS = {"disabledExtensions": {"@jupyterlab/apputils-extension:announcements": True}}

# Questions to the page, in its own language.
NOTEBOOK = "window.jupyterapp?.shell.currentWidget"
IDLE = f"{NOTEBOOK}.sessionContext.session?.kernel?.status === 'idle'"
READY = f"() => {NOTEBOOK}?.context?.isReady && {IDLE}"
RUN_ALL = "() => window.jupyterapp.commands.execute('notebook:run-all-cells')"
FINISHED = f"""() => {IDLE} && [...{NOTEBOOK}.content.model.cells].every(
    cell => cell.type !== 'code' || cell.executionCount !== null || !cell.sharedModel.source.trim())"""
SHUT_DOWN = "() => window.jupyterapp.serviceManager.sessions.shutdownAll()"


def pytest_collection_modifyitems(items):
    """Mark every test of this folder, so that only `-m browser` runs it."""
    for item in items:
        if item.nodeid.startswith("tests/browser/"):
            item.add_marker(pytest.mark.browser)


@pytest.fixture(scope="session")
def lab(tmp_path_factory):
    """(address, folder): a JupyterLab with settings of its own, and the folder it serves."""
    home = tmp_path_factory.mktemp("lab")
    folder, config = home / "served", home / "JUPYTER_CONFIG_DIR" / "labconfig"
    folder.mkdir()
    config.mkdir(parents=True)
    config.joinpath("page_config.json").write_text(json.dumps(NO_NEWS))
    private = "JUPYTER_CONFIG_DIR JUPYTER_DATA_DIR JUPYTER_RUNTIME_DIR IPYTHONDIR MPLCONFIGDIR".split()
    environment = os.environ | {name: str(home / name) for name in private}
    environment.pop("MPLBACKEND", None)  # kernels choose theirs, as they do for people
    shared = home / "share" / "labextensions"
    shared.mkdir(parents=True)
    shutil.copytree(ROOT / "mnclab" / "lab" / "labextension", shared / "mnclab")  # these files, whatever is installed
    environment["JUPYTER_PATH"] = os.pathsep.join(filter(None, [str(shared.parent), environment.get("JUPYTER_PATH")]))
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    address = f"http://127.0.0.1:{port}"
    options = [
        "--no-browser",
        "--allow-root",
        "--ip=127.0.0.1",
        f"--port={port}",
        "--ServerApp.port_retries=0",
        "--IdentityProvider.token=",
        f"--ServerApp.root_dir={folder}",
        "--LabApp.expose_app_in_browser=True",  # gives the page window.jupyterapp
    ]
    log = home / "lab.log"
    with log.open("w") as output:
        command = [sys.executable, "-m", "jupyterlab", *options]
        server = subprocess.Popen(command, env=environment, stdout=output, stderr=subprocess.STDOUT)
    wait_for(address, server, log)
    yield address, folder
    server.terminate()
    server.wait(20)


def wait_for(address, server, log, seconds=60):
    """Return when the server answers; fail with its log when it does not."""
    end = time.monotonic() + seconds
    while server.poll() is None and time.monotonic() < end:
        try:
            urllib.request.urlopen(f"{address}/api", timeout=1).close()
            return
        except OSError:
            time.sleep(0.25)
    server.kill()
    pytest.fail(f"JupyterLab did not start:\n{log.read_text()}", pytrace=False)


@pytest.fixture(scope="session")
def browser():
    """Chromium without a window, driven by playwright."""
    chromium = shutil.which("chromium")
    if chromium is None:
        pytest.fail("browser tests need Debian's chromium: apt-get install chromium", pytrace=False)
    from playwright.sync_api import sync_playwright

    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=FLAGS)
        yield browser
        browser.close()


@pytest.fixture
def opened(browser, tmp_path):
    """opened(run) opens its saved page, which has no network; a word of its console fails the test."""
    faults, contexts = [], []

    def open_page(run):
        context = browser.new_context(viewport={"width": 1366, "height": 768})
        contexts.append(context)
        context.set_offline(True)
        context.route(re.compile("^(?!file:)"), lambda route: faults.append(route.request.url) or route.abort())
        page = context.new_page()
        page.on("console", lambda message: "ReadPixels" in message.text or faults.append(message.text))
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(run.save(tmp_path / "player.html").as_uri())
        page.evaluate(BEGUN)
        return page

    yield open_page
    for context in contexts:
        context.close()
    assert faults == []


@pytest.fixture
def run_notebook(lab, browser):
    """run_notebook(name) opens a served notebook, runs all its cells without a fault and returns the page."""
    address, _ = lab
    pages = []

    def run(name):
        page = browser.new_page(viewport={"width": 1200, "height": 900})
        pages.append(page)
        page.goto(f"{address}/doc/tree/{name}?reset")
        page.wait_for_function(READY, timeout=60_000)
        page.evaluate(RUN_ALL)
        page.wait_for_function(FINISHED, timeout=120_000)
        assert page.locator("[data-mime-type='application/vnd.jupyter.error']").all_inner_texts() == []
        return page

    yield run
    for page in pages:
        page.evaluate(SHUT_DOWN)
        page.close()


@pytest.fixture
def run_cells(lab, run_notebook):
    """run_cells(source, ...) does the same with a new notebook of these cells."""
    import nbformat  # here, as it takes seconds, and every run of the tests reads this file

    _, folder = lab

    def run(*sources):
        cells = [nbformat.v4.new_code_cell(source) for source in sources]
        kernel = {"kernelspec": {"name": "python3", "display_name": "Python 3", "language": "python"}}
        nbformat.write(nbformat.v4.new_notebook(cells=cells, metadata=kernel), folder / "cells.ipynb")
        return run_notebook("cells.ipynb")

    return run


@pytest.fixture
def run_lesson(lab, run_notebook):
    """run_lesson(name) does the same with a copy of one of the project's notebooks, its data beside it."""
    _, folder = lab

    def run(name):
        for part in ("notebooks", "data"):
            if (ROOT / part).is_dir():
                shutil.copytree(ROOT / part, folder / part, dirs_exist_ok=True)
        return run_notebook(f"notebooks/{name}")

    return run
