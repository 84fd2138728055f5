"""The bundled demo, part by part: each module paints one part of the landscape on an easel."""
