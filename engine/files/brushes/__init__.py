"""Brushes of other programs: MyPaint's, GIMP's, Photoshop's and Krita's, as far as they can be painted with here."""
