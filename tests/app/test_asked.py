"""What is asked: each question is shown once, and what follows an answer follows it once."""

from app.desk.asked import Asked


def test_a_dialog_is_shown_once():
    asked = Asked()
    asked.show("open")
    assert (asked.taken(), asked.taken()) == ("open", "")


def test_what_follows_a_save_follows_one_save_alone():
    asked, went = Asked(), []
    asked.saved()
    asked.after_save = lambda: went.append(1)
    asked.saved()
    asked.saved()
    assert went == [1]
    asked.after_save = lambda: went.append(2)
    asked.give_up()
    asked.saved()
    assert went == [1]


def test_one_save_may_be_followed_by_another():
    asked, went = Asked(), []

    def first():
        asked.after_save = lambda: went.append("second")

    asked.after_save = first
    asked.saved()
    assert went == []
    asked.saved()
    assert went == ["second"]
