"""The browser workbench: program, machine and every number on one page.

Read in this order: `guard` (who may talk to the server), `files` (what may be opened), `buffers`
(texts that are being edited), `session` (what one page works on) with `running`, then what the
page asks for: `path_buffer`, `moves`, `machines`; `routes` are the questions, `page` and
`elements` the page itself, `serve` the start. The scripts in `static` are made from the sources in
`workbench_js`.

Nothing here computes a position: the numbers are those of `execution.run`.
"""
